//! `gridshell draw`: a grid on sheets to scale.

use crate::Outcome;
use crate::args::Draw;
use crate::failure::Failure;
use crate::picture::sheet::Wish;
use crate::subject::Measured;
use crate::{open, picture, say};

pub fn run(args: &Draw) -> Result<Outcome, Failure> {
    args.output.iter().try_for_each(|file| picture::check(file))?;
    let measured = Measured::new(open::open(&args.grid)?);
    let wish =
        Wish { sheet: args.view, paper: args.paper, coloring: args.color, labels: &args.labels };
    let mut wrote = String::new();
    for file in &args.output {
        picture::draw_sheet(&measured.subject(), &wish, file)?;
        wrote += &format!("wrote {}\n", file.display());
    }
    say::result(&wrote)?;
    Ok(Outcome::Done)
}
