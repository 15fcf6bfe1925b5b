//! The muscles of the built-in body.

mod arms;
mod persons;
mod write_table;
