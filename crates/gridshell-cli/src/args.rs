//! The arguments.

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args as ClapArgs, Parser, Subcommand};
use gridshell::design;
use gridshell::io::{Choice, Follow, LengthUnit, Opening};
use gridshell::job;
use gridshell_report::colourings;
use gridshell_report::picture::{Labels, Paper, Sheet};
use std::path::PathBuf;

/// Triangular grids for free-form gridshells.
#[derive(Parser)]
#[command(
    name = "gridshell",
    version,
    arg_required_else_help = true,
    after_help = "Exit codes: 0 done, 2 usage, 3 input that cannot be used, 4 no valid grid, \
                  5 stopped by a limit or a signal (the best grid so far is written), \
                  6 done, but parts of the surface have no grid (`--part all`)."
)]
pub struct Args {
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub limits: Limits,
}

/// What a command may take.
#[derive(ClapArgs)]
pub struct Limits {
    /// Stop after so long: with the best grid so far where there is one.
    #[arg(long, global = true, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    pub time_limit: Option<f64>,
    /// Stop before more memory is taken than this, such as 500M or 2G; without it, three quarters of the machine's.
    #[arg(long, global = true, value_name = "SIZE", value_parser = memory)]
    pub memory_limit: Option<u64>,
}

#[derive(Subcommand)]
pub enum Command {
    /// Lay a grid on a surface.
    Generate(Box<Generate>),
    /// Measure a grid.
    Measure(Measure),
    /// Edit a grid: replay a log of edits on it, and suggest more.
    Edit(Edit),
    /// Write a grid in other formats.
    Convert(Convert),
    /// Draw a grid on a sheet to scale.
    Draw(Draw),
    /// Grids side by side, for choosing between them.
    Compare(Compare),
    /// Tell what a file holds: format, units, parts, objects, patches, loops, corners, creases, gaps, what was
    /// skipped, and edge lengths that would suit it.
    Inspect(Inspect),
    /// Open the studio: lay, look at and edit grids in the browser. Only this machine's own browser gets in.
    #[cfg(feature = "studio")]
    Studio(Studio),
    /// List the built-in surfaces, with a sensible edge length each.
    Surfaces,
    /// Write shell completions and man pages, for packages of the command.
    #[command(hide = true)]
    Manual(Manual),
}

/// How the surface is read from its file.
#[derive(ClapArgs)]
pub struct Reading {
    /// Faces that lie within this many metres of each other along their edges are joined; without it, what the file
    /// or the size of the model suggests.
    #[arg(long, value_name = "TOL", value_parser = positive, allow_negative_numbers = true)]
    pub sew: Option<f64>,
    /// Unit of a file that states none, or the wrong one: mm, cm, m, in or ft. Without it what the file states, else
    /// metres.
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    pub units: Option<LengthUnit>,
    /// Layer of a 3DM file to read, by name or path (`Roof::Panels`), with those below it; may be given more than
    /// once. Without it all that the file shows.
    #[arg(long, value_name = "NAME")]
    pub layer: Vec<String>,
    /// Object of a 3DM file to read, by name; may be given more than once.
    #[arg(long, value_name = "NAME")]
    pub object: Vec<String>,
}

impl Reading {
    /// As the library takes it.
    pub fn opening(&self) -> Opening {
        let choice = Choice { layers: self.layer.clone(), objects: self.object.clone() };
        Opening { sew: self.sew, unit: self.units, choice }
    }
}

/// How far grid files are believed.
#[derive(ClapArgs)]
pub struct Following {
    /// Open the surface that a `.gridshell` file refers to wherever that is; without it only in the file's own folder and
    /// below it.
    #[arg(long)]
    follow: bool,
}

impl Following {
    /// As the library takes it.
    pub fn follow(&self) -> Follow {
        if self.follow { Follow::Anywhere } else { Follow::Near }
    }
}

#[derive(ClapArgs)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub struct Generate {
    /// A file (STEP, 3DM, IGES, OBJ, PLY, STL, OFF, glTF, COMPAS JSON) or the name of a built-in surface; a `.gridshell`
    /// file repeats its run.
    #[arg(default_value = "great-court")]
    pub surface: String,
    /// Which of several separate parts to lay the grid on: a number as `inspect` lists them, or `all` for one grid of
    /// several pieces.
    #[arg(long, value_name = "N|all")]
    pub part: Option<String>,
    /// Lay a grid although a part of the file that counts could not be read: an object, or more than a hundredth of its
    /// area. What is missing is told.
    #[arg(long)]
    pub accept_losses: bool,
    /// Wanted length of the members, metres.
    #[arg(short = 'l', long, value_name = "L", value_parser = positive, conflicts_with = "nodes", allow_negative_numbers = true)]
    pub edge_length: Option<f64>,
    /// Wanted number of nodes.
    #[arg(short, long, value_name = "N")]
    pub nodes: Option<usize>,
    #[command(flatten)]
    pub reading: Reading,
    #[command(flatten)]
    pub following: Following,
    /// Seed of every random choice.
    #[arg(short, long, value_name = "S")]
    pub seed: Option<u64>,
    /// Lengths that vary: `curvature`, or a file of lines `x, y, z, length` (with an edge length or a number of
    /// nodes only their proportions count).
    #[arg(long, value_name = "curvature|FILE")]
    pub size: Option<String>,
    /// Direction of one family of lines: a vector `x,y,z`, a file of lines `x, y, z, dx, dy, dz`, or `boundary` for
    /// the longest stretch of the boundary.
    #[arg(long, value_name = "x,y,z|FILE|boundary", allow_hyphen_values = true)]
    pub direction: Option<String>,
    /// Symmetry of the surface that the grid is to have too: `auto` for the largest that the surface has, mirror planes
    /// perpendicular to `x`, `y` or both (`xy`), or a number of turns about a vertical axis.
    #[arg(long, value_name = "auto|x|y|xy|N")]
    pub symmetry: Option<String>,
    /// Priority of well-shaped border panels over straight interior lines: 0 (lattice simply trimmed) to 1 (rows follow
    /// every border).
    #[arg(long, value_name = "0..1", allow_negative_numbers = true)]
    pub border: Option<f64>,
    /// How much work to put in: `draft`, `standard` or `best`.
    #[arg(long, value_name = "LEVEL")]
    pub effort: Option<String>,
    /// Grids made side by side, of which the best is kept.
    #[arg(long, value_name = "N")]
    pub candidates: Option<usize>,
    /// Method: `default`, or `paper` for the method as printed.
    #[arg(short, long, value_name = "NAME")]
    pub method: Option<String>,
    /// Edges where the surface turns by more than this become lines of members, degrees; 180 finds none.
    #[arg(long, value_name = "DEG", value_parser = positive, allow_negative_numbers = true)]
    pub feature_angle: Option<f64>,
    /// Lay the grid on a smooth surface through the vertices of a mesh, where its edges are longer than half a member.
    #[arg(long)]
    pub smooth_input: bool,
    /// Polylines that become lines of members: an OBJ file with `v` and `l`, or a text with one point `x y z` a
    /// line and a blank line between polylines.
    #[arg(long, value_name = "FILE")]
    pub guides: Option<PathBuf>,
    /// A point on the surface that becomes a node; may be given more than once.
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    pub anchor: Vec<[f64; 3]>,
    /// Points that become nodes: a text with one point `x y z` a line.
    #[arg(long, value_name = "FILE")]
    pub anchors: Option<PathBuf>,
    /// Recipe with all options; flags override it.
    #[arg(short, long, value_name = "FILE.toml")]
    pub recipe: Option<PathBuf>,
    /// Where to write the grid, in the format of the name's end: gridshell, obj, ply, stl, off, glb, dxf, csv,
    /// compas.json, vtu, saf.xlsx, ifc, tcl; may be given more than once. Without it, `<name>.obj` in the current folder.
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    #[command(flatten)]
    pub handover: Handover,
    #[command(flatten)]
    pub alike: Alike,
    /// One page of the whole run with pictures, a view to turn, figures and tables; opens without a network.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Write a grid that is not valid all the same, marked as such, instead of ending with code 4.
    #[arg(long)]
    pub keep_invalid: bool,
    /// Print one JSON document on stdout, and nothing else there.
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the grid does not depend on it.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// What hand-over files state beside the grid.
#[derive(ClapArgs)]
pub struct Handover {
    /// Supported nodes: `boundary` (default), `corners`, `none`, or a text with one point `x y z` a line.
    #[arg(long, value_name = "boundary|corners|FILE|none")]
    pub supports: Option<String>,
    /// Section of all members, millimetres: `RHS 100x60x5` (height x width x wall), `CHS 88.9x5`, `REC 120x60`.
    #[arg(long, value_name = "SECTION", default_value = "RHS 100x60x5")]
    pub section: String,
    /// Material of all members: S235, S275, S355, GL24h or EN AW-6082.
    #[arg(long, value_name = "NAME", default_value = "S355")]
    pub material: String,
    /// Thickness of the panels, millimetres.
    #[arg(long, value_name = "MM", value_parser = positive, default_value = "16", allow_negative_numbers = true)]
    pub pane: f64,
    /// Version of SAF files: 2.0.0 or 1.0.5.
    #[arg(long, value_name = "VERSION", default_value = "2.0.0")]
    pub saf: String,
}

/// Within what elements count as alike.
#[derive(ClapArgs)]
pub struct Alike {
    /// Members of a group differ in length by at most this, metres; without it a two hundredth of the mean length.
    #[arg(long, value_name = "L", value_parser = positive, allow_negative_numbers = true)]
    pub length_tolerance: Option<f64>,
    /// Nodes of a group differ in their angles by at most this, degrees; without it 1.
    #[arg(long, value_name = "DEG", value_parser = positive, allow_negative_numbers = true)]
    pub angle_tolerance: Option<f64>,
}

/// A grid from a file, on its surface.
#[derive(ClapArgs)]
pub struct GridArgs {
    /// A grid: a `.gridshell` file or a triangle mesh (OBJ, PLY, STL, OFF, glTF, COMPAS JSON).
    pub grid: PathBuf,
    #[command(flatten)]
    pub reopening: Reopening,
}

/// How grids from files are opened.
#[derive(ClapArgs)]
pub struct Reopening {
    /// The surface that a grid was laid on: a file or a built-in name. Without it a `.gridshell` file tells, and else
    /// the grid itself is the surface.
    #[arg(short, long, value_name = "SURFACE")]
    surface: Option<String>,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    following: Following,
    #[command(flatten)]
    alike: Alike,
}

impl Reopening {
    /// As the library has it.
    pub fn given(&self) -> design::Reopening {
        design::Reopening {
            surface: self.surface.clone(),
            follow: self.following.follow(),
            opening: self.reading.opening(),
            length_tolerance: self.alike.length_tolerance,
            angle_tolerance_deg: self.alike.angle_tolerance,
        }
    }
}

#[derive(ClapArgs)]
pub struct Convert {
    #[command(flatten)]
    pub grid: GridArgs,
    /// Where to write it, in the format of the name's end, as for `generate`; may be given more than once.
    #[arg(short, long, value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,
    #[command(flatten)]
    pub handover: Handover,
}

#[derive(ClapArgs)]
pub struct Measure {
    #[command(flatten)]
    pub grid: GridArgs,
    /// One page of the grid with pictures, a view to turn, figures and tables; opens without a network.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Print one JSON document on stdout, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs)]
pub struct Draw {
    #[command(flatten)]
    pub grid: GridArgs,
    /// Where to draw it: .svg, .png or .pdf; may be given more than once.
    #[arg(short, long, value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,
    /// What the sheet shows.
    #[arg(long, value_enum, default_value = "plan")]
    pub view: Sheet,
    /// What the colours show.
    #[arg(long, value_parser = colourings(), default_value = "length")]
    pub color: String,
    /// Whose numbers are written beside them, as in the schedules; separated by commas.
    #[arg(long, value_enum, value_delimiter = ',')]
    pub labels: Vec<Labels>,
    /// The paper, in landscape; `none` makes a small picture.
    #[arg(long, value_enum, default_value = "a1")]
    pub paper: Paper,
}

/// The keys of the table of colourings, and none.
fn colourings() -> PossibleValuesParser {
    let all = colourings::ALL
        .iter()
        .map(|c| PossibleValue::new(c.key).help(c.help.trim_end_matches('.')));
    all.chain([PossibleValue::new("none").help("No colours")]).collect::<Vec<_>>().into()
}

#[derive(ClapArgs)]
pub struct Compare {
    /// The grids: `.gridshell` files or triangle meshes.
    #[arg(required = true, num_args = 1.., value_name = "GRID")]
    pub grids: Vec<PathBuf>,
    #[command(flatten)]
    pub reopening: Reopening,
    /// A page with the table and a plan of each grid.
    #[arg(long, value_name = "FILE.html")]
    pub html: Option<PathBuf>,
    /// Print one JSON document on stdout, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs)]
pub struct Edit {
    #[command(flatten)]
    pub grid: GridArgs,
    /// The edits, as JSON: see docs/editing.md.
    #[arg(long, value_name = "FILE.json")]
    pub log: Option<PathBuf>,
    /// Where to write the edited grid, in the format of the name's end, as for `generate`; may be given more than once.
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    #[command(flatten)]
    pub handover: Handover,
    /// Write a grid that the edits made invalid all the same, marked as such, instead of ending with code 4.
    #[arg(long)]
    pub keep_invalid: bool,
    /// Suggest up to N further edits that would improve the grid, best first.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub suggest: usize,
    /// Print one JSON document on stdout, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs)]
pub struct Inspect {
    /// A file (STEP, 3DM, IGES, OBJ, PLY, STL, OFF, glTF, COMPAS JSON) or the name of a built-in surface.
    pub surface: String,
    #[command(flatten)]
    pub reading: Reading,
    /// Draw it, in plan and in perspective (SVG, PNG or PDF by extension); may be given more than once.
    #[arg(long, value_name = "FILE")]
    pub picture: Vec<PathBuf>,
    /// Print one JSON document on stdout, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

#[cfg(feature = "studio")]
#[derive(ClapArgs)]
pub struct Studio {
    /// A file (STEP, 3DM, IGES, OBJ, PLY, STL, OFF, glTF, COMPAS JSON) or the name of a built-in surface to begin with;
    /// a `.gridshell` file is reopened for further work.
    #[arg(default_value = "great-court")]
    pub surface: String,
    /// Port of 127.0.0.1; without it a free one.
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// Print the address, and leave opening the browser to the user.
    #[arg(long)]
    pub no_browser: bool,
    /// Where grids are kept against crashes; without it a folder of the user's.
    #[arg(long, value_name = "FOLDER", conflicts_with = "no_autosave")]
    pub state: Option<PathBuf>,
    /// Keep no grids against crashes.
    #[arg(long)]
    pub no_autosave: bool,
    /// A folder with a built page instead of the one in this program, for working on the page.
    #[arg(long, value_name = "FOLDER", hide = true)]
    pub page: Option<PathBuf>,
}

#[derive(ClapArgs)]
pub struct Manual {
    /// Where to write them: in the folders `completions` and `man` below it, which are made.
    pub folder: PathBuf,
}

fn memory(text: &str) -> Result<u64, String> {
    job::memory::parse(text).map_err(|e| e.to_string())
}

/// A positive number that is not an infinity; a billion of anything is enough.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 1e9 => Ok(x),
        Ok(_) => Err("it must be positive, and at most a billion".to_owned()),
        Err(_) => Err("it must be a number".to_owned()),
    }
}

fn unit(text: &str) -> Result<LengthUnit, String> {
    text.parse().map_err(|e: gridshell::Error| e.to_string())
}

/// Three coordinates.
fn point(text: &str) -> Result<[f64; 3], String> {
    let numbers: Vec<f64> = text.split(',').filter_map(|x| x.trim().parse().ok()).collect();
    let whole = numbers.len() == text.split(',').count();
    match <[f64; 3]>::try_from(numbers) {
        Ok(p) if whole && p.iter().all(|x| x.is_finite()) => Ok(p),
        _ => Err("it must be three numbers x,y,z in metres".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Args::command().debug_assert();
    }

    #[test]
    fn lengths_that_are_no_lengths_are_refused() {
        for text in ["0", "-1", "nan", "inf", "1e300", "two"] {
            assert!(positive(text).is_err(), "{text}");
        }
        assert_eq!(positive("2.12"), Ok(2.12));
    }

    #[test]
    fn points_that_are_no_points_are_refused() {
        for text in ["", "1,2", "1,2,3,4", "1,b,3", "1,b,3,4", "1,2,nan", "1 2 3"] {
            assert!(point(text).is_err(), "{text}");
        }
        assert_eq!(point("-1, 2.5,3e1"), Ok([-1.0, 2.5, 30.0]));
    }
}
