//! `gridshell draw`: a grid on sheets to scale.

use crate::Outcome;
use crate::args::Draw;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{handover, open, say};
use gridshell_report::colourings;
use gridshell_report::picture::{self, Wish};

pub fn run(args: &Draw, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.output.iter().try_for_each(|file| picture::check(file)).map_err(Failure::of_output)?;
    let design = open::open(&args.grid, job)?;
    let colouring = colourings::of(&args.color);
    let wish = Wish { sheet: args.view, paper: args.paper, colouring, labels: &args.labels };
    let (mut wrote, mut drawn) = (Vec::new(), Vec::new());
    for file in &args.output {
        let done = picture::draw_sheet(&design, &wish, file).map_err(Failure::of_output);
        if done.is_ok() {
            wrote.push(format!("wrote {}", file.display()));
        }
        drawn.push(done);
    }
    work.told();
    handover::all_or_told(&wrote, drawn)?;
    say::result(&(wrote.join("\n") + "\n"))?;
    Ok(Outcome::Done)
}
