//! The studio: gridshell in a browser. A server on this machine's loopback address, and the page that it serves.
//!
//! ```text
//! page ──Request (JSON)──▶ server ──▶ Desk ──▶ gridshell::pipeline
//!      ◀──Event (JSON), frames of flat arrays──┘   (Job: progress, pictures)
//! ```
//!
//! - [`message`]: every message, and the head of every frame; the page's types are generated from it.
//! - [`Studio::bind`] opens the socket, [`Studio::address`] is what the browser is given, [`Studio::serve`] answers.
//!
//! All geometry is in the library: the page draws arrays and asks what is under the pointer. Nothing that the page
//! sends becomes a path on the disk: files come in and go out through the browser. Against crashes grids are kept in a
//! folder of the user's ([`Options::state`]).

mod aside;
mod candidate;
mod color;
mod desk;
mod editing;
mod export;
mod form;
mod frame;
mod guard;
mod laid;
mod lanes;
mod laying;
mod listen;
mod measures;
pub mod message;
mod opened;
mod page;
mod pick;
mod redirect;
mod scene;
mod server;
mod session;
mod tab;
mod told;

pub use redirect::Redirect;
pub use server::Log;
pub use tab::Tab;

use desk::Desk;
use guard::Guard;
use page::Page;
use server::Server;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::sync::Notify;

/// The file that a browser is opened with is removed after so long, whether the page was asked for or not: a browser
/// that starts on a busy machine may take a while.
const REDIRECTED: Duration = Duration::from_secs(120);

/// How the studio is opened.
pub struct Options {
    /// Name of a built-in surface or path of a file to begin with: a surface, or a grid with its surface.
    pub surface: String,
    /// Port of 127.0.0.1; 0 takes a free one.
    pub port: u16,
    /// Where refusals are written.
    pub log: Log,
    /// A folder with a built page, instead of the one in this program.
    pub page: Option<PathBuf>,
    /// The folder where grids are kept against crashes; without it they are not.
    pub state: Option<PathBuf>,
    /// What the process may hold in memory before work is refused or stopped, bytes.
    pub memory_limit: Option<u64>,
}

/// Why the studio cannot be opened.
#[derive(Debug)]
pub enum Error {
    /// The surface cannot be opened.
    Surface(gridshell::Error),
    /// The socket or the page's folder.
    Io(std::io::Error),
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Error::Surface(e) => e.fmt(f),
            Error::Io(e) => write!(f, "the studio: {e}"),
        }
    }
}

impl std::error::Error for Error {}

impl From<std::io::Error> for Error {
    fn from(error: std::io::Error) -> Error {
        Error::Io(error)
    }
}

/// A studio with its socket open.
pub struct Studio {
    listener: TcpListener,
    server: Arc<Server>,
    address: SocketAddr,
}

impl Studio {
    /// Open the surface and a socket on 127.0.0.1.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn bind(options: Options) -> Result<Studio, Error> {
        let desk = Arc::new(Desk::new(options.memory_limit));
        desk.open(&options.surface).map_err(Error::Surface)?;
        if let Some(folder) = &options.state
            && let Err(e) = desk.keep_in(folder, Arc::clone(&options.log))
        {
            let fault = format!("{}: {e}", folder.display());
            (options.log)(&format!("no autosave: {fault}"));
            desk.autosave(Some(fault));
        }
        let page = match options.page {
            Some(folder) => Page::in_folder(&folder)?,
            None => Page::built_in(),
        };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, options.port)).await?;
        let address = listener.local_addr()?;
        let guard = Guard::new(address.port())?;
        Ok(Studio {
            listener,
            address,
            server: Arc::new(Server {
                guard,
                desk,
                page,
                log: options.log,
                entered: Notify::new(),
            }),
        })
    }

    /// The address for the browser, token and all.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.address, self.server.guard.token())
    }

    /// Answer until the process ends.
    pub async fn serve(self) {
        listen::serve(self.listener, server::router(self.server)).await;
    }
}

/// Open a studio, tell its address, and serve it until the process ends. The file that `told` opens a browser with is
/// kept until the browser has come.
///
/// # Errors
/// [`Error`].
pub fn run(options: Options, told: impl FnOnce(&str) -> Option<Redirect>) -> Result<(), Error> {
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    runtime.block_on(async {
        let studio = Studio::bind(options).await?;
        let redirect = told(&studio.address());
        let server = Arc::clone(&studio.server);
        tokio::spawn(async move {
            let _ = tokio::time::timeout(REDIRECTED, server.entered.notified()).await;
            drop(redirect);
        });
        studio.serve().await;
        Ok(())
    })
}
