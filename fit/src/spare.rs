//! What is made once for each thread and lent from then on: interpreters and room for a block, which cost as much as some blocks of rows.

use std::sync::{Mutex, PoisonError};

/// Those that nobody uses at the moment.
#[derive(Debug)]
pub(super) struct Spare<T>(Mutex<Vec<T>>);

impl<T> Default for Spare<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T> Clone for Spare<T> {
    /// Without any: whoever clones makes its own.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl<T> Spare<T> {
    /// One in use.
    pub(super) fn lent(&self) -> Lent<'_, T> {
        let own = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        Lent { own, to: self }
    }
}

/// One in use, which is spare again when it is done with.
pub(super) struct Lent<'a, T> {
    own: Option<T>,
    to: &'a Spare<T>,
}

impl<T> Lent<'_, T> {
    /// Itself; made now where none was spare.
    pub(super) fn get_or_make(&mut self, make: impl FnOnce() -> T) -> &mut T {
        self.own.get_or_insert_with(make)
    }
}

impl<T> Drop for Lent<'_, T> {
    fn drop(&mut self) {
        self.to.0.lock().unwrap_or_else(PoisonError::into_inner).extend(self.own.take());
    }
}
