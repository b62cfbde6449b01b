//! Workbooks (`.xlsx`, Office Open XML, ECMA-376), no more of them than tables need: sheets of texts and numbers. Written
//! row by row as text and packed at once, because a library that keeps every cell takes four times as long and two
//! gigabytes for ten million of them.

use super::WRITING;
use super::digest::Quick;
use crate::job::Job;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::hash::BuildHasherDefault;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// Rows of a sheet, its header included.
pub(super) const MOST_ROWS: usize = 1_048_576;
/// Large sheets are packed in the shortest time.
const PACKING: i64 = 1;

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const OFFICE: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006";
const SHEET_TYPE: &str = "application/vnd.openxmlformats-officedocument.spreadsheetml";

/// A cell.
pub(super) enum Cell<'a> {
    Blank,
    Number(f64),
    Text(&'a str),
    Made(String),
}

/// Sheets in their order, as they grow.
pub(super) struct Workbook<'a> {
    /// Once it is over nothing more is put; the caller is to check.
    job: &'a Job,
    sheets: Vec<Sheet>,
    texts: Texts,
}

struct Sheet {
    name: &'static str,
    rows: String,
    count: usize,
}

/// Every text once; cells tell its number.
#[derive(Default)]
struct Texts {
    numbers: HashMap<String, usize, BuildHasherDefault<Quick>>,
    items: String,
    uses: usize,
}

impl<'a> Workbook<'a> {
    /// One without sheets.
    pub(super) fn new(job: &'a Job) -> Workbook<'a> {
        Workbook { job, sheets: Vec::new(), texts: Texts::default() }
    }

    /// Begin a sheet.
    pub(super) fn sheet(&mut self, name: &'static str) {
        self.sheets.push(Sheet { name, rows: String::new(), count: 0 });
    }

    /// Put a row below the others of the latest sheet.
    pub(super) fn row(&mut self, cells: &[Cell]) {
        // The caller is to check.
        if self.job.is_over(WRITING) {
            return;
        }
        let sheet = self.sheets.last_mut().expect("a sheet was begun");
        sheet.count += 1;
        // Ten million cells are quick without the machinery of formats.
        let (out, row) = (&mut sheet.rows, Digits::of(sheet.count));
        let row = row.text();
        out.extend(["<row r=\"", row, "\">"]);
        for (column, cell) in cells.iter().enumerate() {
            let text = match cell {
                Cell::Blank => continue,
                Cell::Number(_) => None,
                Cell::Text(text) => Some(*text),
                Cell::Made(text) => Some(text.as_str()),
            };
            out.push_str("<c r=\"");
            out.push(char::from(b'A' + column as u8));
            out.push_str(row);
            match (text, cell) {
                (Some(text), _) => {
                    let number = Digits::of(self.texts.number(text));
                    out.extend(["\" t=\"s\"><v>", number.text(), "</v></c>"]);
                }
                (None, Cell::Number(x)) => {
                    let _ = write!(out, "\"><v>{x}</v></c>");
                }
                (None, _) => unreachable!("texts were told above"),
            }
        }
        out.push_str("</row>");
    }

    /// The file's bytes. The same tables give the same bytes on any day.
    pub(super) fn pack(&self) -> zip::result::ZipResult<Vec<u8>> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        let mut put = |name: &str, parts: &[&str]| {
            let options = SimpleFileOptions::default()
                .compression_method(CompressionMethod::Deflated)
                .compression_level(Some(PACKING))
                .last_modified_time(zip::DateTime::default());
            zip.start_file(name, options)?;
            parts.iter().try_for_each(|part| zip.write_all(part.as_bytes()))?;
            zip::result::ZipResult::Ok(())
        };
        put("[Content_Types].xml", &[HEAD, &self.types()])?;
        let root = format!(
            "<Relationships xmlns=\"{PACKAGE}/relationships\"><Relationship Id=\"rId1\" \
             Type=\"{OFFICE}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
        );
        put("_rels/.rels", &[HEAD, &root])?;
        put("xl/workbook.xml", &[HEAD, &self.index()])?;
        put("xl/_rels/workbook.xml.rels", &[HEAD, &self.relations()])?;
        put("xl/styles.xml", &[HEAD, &styles()])?;
        let open = format!("<worksheet xmlns=\"{MAIN}\"><sheetData>");
        for (k, sheet) in self.sheets.iter().enumerate() {
            let name = format!("xl/worksheets/sheet{}.xml", k + 1);
            put(&name, &[HEAD, &open, &sheet.rows, "</sheetData></worksheet>"])?;
        }
        let Texts { numbers, items, uses } = &self.texts;
        let count = numbers.len();
        let open = format!("<sst xmlns=\"{MAIN}\" count=\"{uses}\" uniqueCount=\"{count}\">");
        put("xl/sharedStrings.xml", &[HEAD, &open, items, "</sst>"])?;
        Ok(zip.finish()?.into_inner())
    }

    /// What kind of thing each file of the package is.
    fn types(&self) -> String {
        let mut out = format!(
            "<Types xmlns=\"{PACKAGE}/content-types\"><Default Extension=\"rels\" \
             ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
             <Default Extension=\"xml\" ContentType=\"application/xml\"/>"
        );
        let mut put = |name: &str, kind: &str| {
            let _ = write!(
                out,
                "<Override PartName=\"/xl/{name}.xml\" ContentType=\"{SHEET_TYPE}.{kind}+xml\"/>"
            );
        };
        put("workbook", "sheet.main");
        put("styles", "styles");
        put("sharedStrings", "sharedStrings");
        for k in 1..=self.sheets.len() {
            put(&format!("worksheets/sheet{k}"), "worksheet");
        }
        out + "</Types>"
    }

    fn index(&self) -> String {
        let mut out = format!("<workbook xmlns=\"{MAIN}\" xmlns:r=\"{OFFICE}\"><sheets>");
        for (k, Sheet { name, .. }) in (1..).zip(&self.sheets) {
            let _ = write!(out, "<sheet name=\"{name}\" sheetId=\"{k}\" r:id=\"rId{k}\"/>");
        }
        out + "</sheets></workbook>"
    }

    fn relations(&self) -> String {
        let mut out = format!("<Relationships xmlns=\"{PACKAGE}/relationships\">");
        let count = self.sheets.len();
        let sheets = (1..=count).map(|k| (k, "worksheet", format!("worksheets/sheet{k}")));
        let others = ["styles", "sharedStrings"];
        let others = others.iter().enumerate().map(|(k, o)| (count + 1 + k, *o, (*o).to_owned()));
        for (k, kind, target) in sheets.chain(others) {
            let _ = write!(
                out,
                "<Relationship Id=\"rId{k}\" Type=\"{OFFICE}/{kind}\" Target=\"{target}.xml\"/>"
            );
        }
        out + "</Relationships>"
    }
}

impl Texts {
    fn number(&mut self, text: &str) -> usize {
        self.uses += 1;
        if let Some(&number) = self.numbers.get(text) {
            return number;
        }
        let number = self.numbers.len();
        self.numbers.insert(text.to_owned(), number);
        self.items.push_str("<si><t xml:space=\"preserve\">");
        for c in text.chars() {
            match c {
                '&' => self.items.push_str("&amp;"),
                '<' => self.items.push_str("&lt;"),
                '>' => self.items.push_str("&gt;"),
                c if c.is_control() => self.items.push(' '),
                c => self.items.push(c),
            }
        }
        self.items.push_str("</t></si>");
        number
    }
}

/// The digits of a whole number.
struct Digits {
    /// From `first` on.
    bytes: [u8; 20],
    first: usize,
}

impl Digits {
    fn of(mut number: usize) -> Digits {
        let mut digits = Digits { bytes: [b'0'; 20], first: 20 };
        loop {
            digits.first -= 1;
            digits.bytes[digits.first] = b'0' + (number % 10) as u8;
            number /= 10;
            if number == 0 {
                return digits;
            }
        }
    }

    fn text(&self) -> &str {
        std::str::from_utf8(&self.bytes[self.first..]).unwrap_or_default()
    }
}

/// One font, no fills, no borders: some programs refuse a workbook without any.
fn styles() -> String {
    format!(
        "<styleSheet xmlns=\"{MAIN}\"><fonts count=\"1\"><font><sz val=\"11\"/><name val=\"Calibri\"/></font></fonts>\
         <fills count=\"2\"><fill><patternFill patternType=\"none\"/></fill><fill><patternFill patternType=\"gray125\"/>\
         </fill></fills><borders count=\"1\"><border><left/><right/><top/><bottom/><diagonal/></border></borders>\
         <cellStyleXfs count=\"1\"><xf numFmtId=\"0\" fontId=\"0\" fillId=\"0\" borderId=\"0\"/></cellStyleXfs>\
         <cellXfs count=\"1\"><xf numFmtId=\"0\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\"/></cellXfs>\
         <cellStyles count=\"1\"><cellStyle name=\"Normal\" xfId=\"0\" builtinId=\"0\"/></cellStyles></styleSheet>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_of_the_number() {
        for number in [0, 7, 10, 1_048_576, usize::MAX] {
            assert_eq!(Digits::of(number).text(), number.to_string());
        }
    }

    #[test]
    fn a_text_is_kept_once_and_its_signs_are_escaped() {
        let job = Job::default();
        let mut book = Workbook::new(&job);
        book.sheet("A");
        book.row(&[Cell::Text("a<b&c"), Cell::Blank, Cell::Number(0.5)]);
        book.row(&[Cell::Made("a<b&c".into()), Cell::Text("d")]);
        assert_eq!((book.texts.numbers.len(), book.texts.uses), (2, 3));
        assert!(book.texts.items.contains("a&lt;b&amp;c"));
        let rows = &book.sheets[0].rows;
        assert!(rows.contains("<c r=\"C1\"><v>0.5</v></c>") && !rows.contains("B1"));
        let bytes = book.pack().unwrap();
        assert_eq!(&bytes[..2], b"PK");
        assert!(bytes == book.pack().unwrap(), "the same bytes each time");
    }
}
