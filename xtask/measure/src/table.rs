//! Text tables that are readable in a terminal and as Markdown.

pub(crate) use ambulo::study::validation::TextTable as Table;
