//! Tables that read as text and as Markdown.

use std::iter;

/// Rows of cells under a head; the first column is left-aligned, the others are right-aligned.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextTable {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl TextTable {
    /// An empty table.
    #[must_use]
    pub fn new(head: &[&str]) -> TextTable {
        TextTable { head: head.iter().map(|&cell| cell.to_owned()).collect(), rows: Vec::new() }
    }

    /// Adds a row; it has as many cells as the head.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        let cells: Vec<String> = cells.into_iter().collect();
        debug_assert_eq!(cells.len(), self.head.len(), "one cell per column");
        self.rows.push(cells);
    }

    /// Names of the columns.
    #[must_use]
    pub fn head(&self) -> &[String] {
        &self.head
    }

    /// The rows below the head.
    #[must_use]
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    /// The table as Markdown with aligned columns. A bar in a cell, which would begin another one, is escaped.
    #[must_use]
    pub fn text(&self) -> String {
        let escaped = |row: &Vec<String>| row.iter().map(|cell| escaped(cell)).collect::<Vec<_>>();
        let rows: Vec<Vec<String>> = iter::once(&self.head).chain(&self.rows).map(escaped).collect();
        let widths: Vec<usize> = (0..self.head.len())
            .map(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0).max(3))
            .collect();
        let line = |row: &Vec<String>| {
            let padded = row.iter().zip(&widths).enumerate().map(|(column, (cell, &width))| match column {
                0 => format!(" {cell:<width$} "),
                _ => format!(" {cell:>width$} "),
            });
            format!("|{}|\n", padded.collect::<Vec<_>>().join("|"))
        };
        let rule = widths.iter().enumerate().map(|(column, width)| match column {
            0 => format!(":{}", "-".repeat(width + 1)),
            _ => format!("{}:", "-".repeat(width + 1)),
        });
        let rule = format!("|{}|\n", rule.collect::<Vec<_>>().join("|"));
        line(&rows[0]) + &rule + &rows[1..].iter().map(line).collect::<String>()
    }
}

/// A cell without what Markdown would read as the end of the cell or of the line.
fn escaped(cell: &str) -> String {
    cell.replace('|', "\\|").replace(['\n', '\r'], " ")
}
