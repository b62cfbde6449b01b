//! A table, as Markdown and as text.

/// Rows of cells; the first row is the head.
pub struct Table(pub Vec<Vec<String>>);

impl Table {
    /// As Markdown has it.
    pub fn markdown(&self) -> String {
        let mut text = String::new();
        for (k, row) in self.0.iter().enumerate() {
            text += &format!("| {} |\n", row.join(" | "));
            if k == 0 {
                text += &format!("|---{}|\n", "|---:".repeat(row.len() - 1));
            }
        }
        text
    }

    /// Columns aligned for a terminal.
    pub fn text(&self) -> String {
        let columns = self.0.iter().map(Vec::len).max().unwrap_or(0);
        let width = |k: usize| {
            self.0.iter().filter_map(|row| row.get(k)).map(|c| c.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut text = String::new();
        for row in &self.0 {
            for (k, cell) in row.iter().enumerate() {
                let width = widths[k];
                text +=
                    &if k == 0 { format!("{cell:width$}") } else { format!("  {cell:>width$}") };
            }
            text = text.trim_end().to_owned() + "\n";
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn both_forms_keep_every_cell_in_its_column() {
        let rows = [["", "a"], ["mu", "0.1 ✗"]];
        let table = Table(rows.map(|r| r.map(str::to_owned).to_vec()).to_vec());
        assert_eq!(table.markdown(), "|  | a |\n|---|---:|\n| mu | 0.1 ✗ |\n");
        assert_eq!(table.text(), "        a\nmu  0.1 ✗\n");
    }
}
