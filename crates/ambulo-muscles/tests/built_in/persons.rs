//! The set on bodies of several sizes.
