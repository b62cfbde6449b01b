//! `gridshell draw`: a grid on sheets to scale.

use crate::Outcome;
use crate::args::Draw;
use crate::failure::Failure;
use crate::picture::sheet::Wish;
use crate::progress::Work;
use crate::subject::Measured;
use crate::{open, picture, say};

pub fn run(args: &Draw, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.output.iter().try_for_each(|file| picture::check(file))?;
    let measured = Measured::new(open::open(&args.grid, job)?, job)?;
    let wish =
        Wish { sheet: args.view, paper: args.paper, coloring: args.color, labels: &args.labels };
    let mut wrote = String::new();
    for file in &args.output {
        picture::draw_sheet(&measured.subject(), &wish, file)?;
        wrote += &format!("wrote {}\n", file.display());
    }
    work.told();
    measured.notes().iter().for_each(|n| say::note(&format!("note: {n}")));
    say::result(&wrote)?;
    Ok(Outcome::Done)
}
