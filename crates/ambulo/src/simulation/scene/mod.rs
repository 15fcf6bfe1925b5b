//! Scenes: a world, its outputs and its duration as a TOML file.
