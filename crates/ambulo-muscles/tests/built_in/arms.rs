//! Moment arms of the built-in body compared with those of Gait2392.
