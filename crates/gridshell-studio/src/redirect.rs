//! The file that a browser is opened with, instead of the address: what a program is started with, everybody on the
//! machine can see, and the address has the token in it. The file is this user's only, and sends on to the address.

use std::io::{self, Write};
use std::path::PathBuf;
use tempfile::TempDir;

/// The file's name.
const NAME: &str = "studio.html";

/// A file that sends a browser on, until this is dropped.
pub struct Redirect {
    folder: TempDir,
}

impl Redirect {
    /// One to this address, in a folder for this user only.
    ///
    /// # Errors
    /// What the system says.
    pub fn to(address: &str) -> io::Result<Redirect> {
        let mut builder = tempfile::Builder::new();
        builder.prefix("gridshell-");
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
        let folder = builder.tempdir()?;
        let mut options = std::fs::File::options();
        options.write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let page = format!(
            "<!doctype html>\n<meta charset=\"utf-8\">\n<meta name=\"referrer\" content=\"no-referrer\">\n\
             <meta http-equiv=\"refresh\" content=\"0; url={address}\">\n<title>gridshell studio</title>\n\
             <p>The studio is <a href=\"{address}\">here</a>.\n"
        );
        options.open(folder.path().join(NAME))?.write_all(page.as_bytes())?;
        Ok(Redirect { folder })
    }

    /// Where it is.
    pub fn path(&self) -> PathBuf {
        self.folder.path().join(NAME)
    }
}

#[cfg(test)]
mod tests {
    use super::Redirect;

    #[test]
    fn only_the_user_can_read_it_and_it_goes() {
        let address = "http://127.0.0.1:1234/0123/";
        let redirect = Redirect::to(address).unwrap();
        let path = redirect.path();
        assert!(std::fs::read_to_string(&path).unwrap().contains(&format!("url={address}\"")));
        #[cfg(unix)]
        for (path, wanted) in [(path.as_path(), 0o600), (path.parent().unwrap(), 0o700)] {
            let mode =
                std::os::unix::fs::PermissionsExt::mode(&path.metadata().unwrap().permissions());
            assert_eq!(mode & 0o777, wanted, "{}", path.display());
        }
        drop(redirect);
        assert!(!path.parent().unwrap().exists());
    }
}
