//! The muscles of the built-in body.

mod arms;
mod contact;
mod laboratories;
mod persons;
mod write_table;
