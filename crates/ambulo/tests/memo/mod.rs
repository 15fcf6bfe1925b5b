//! Results that several tests need; each is computed once in a process.

use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Values by their names.
pub(crate) struct Memo<T: 'static>(Mutex<BTreeMap<String, &'static OnceLock<T>>>);

impl<T> Memo<T> {
    pub(crate) const fn new() -> Memo<T> {
        Memo(Mutex::new(BTreeMap::new()))
    }

    /// The value of this name; `make` makes it if no test has.
    pub(crate) fn get(&self, name: String, make: impl FnOnce() -> T) -> &'static T {
        // The lock is not held while a value is made, so that tests of different ones do not wait for each other.
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let value = *all.entry(name).or_insert_with(|| Box::leak(Box::default()));
        drop(all);
        value.get_or_init(make)
    }
}
