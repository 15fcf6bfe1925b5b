//! Tests of the muscles against OpenSim 4.6, closed forms and identities.

mod built_in;
mod people;
mod shared_data;
