//! Work that the searches of a row may take together.

use std::cell::Cell;

/// Products that the searches of a row may take still. They are counted, not timed: the result is the same on any machine.
#[derive(Debug)]
pub(crate) struct Budget {
    left: Cell<f64>,
    cut_short: Cell<bool>,
}

impl Budget {
    /// A budget of so many products.
    pub fn new(products: f64) -> Budget {
        Budget { left: Cell::new(products), cut_short: Cell::new(false) }
    }

    /// Takes off the products of a search.
    pub fn take(&self, products: f64) {
        self.left.set(self.left.get() - products);
    }

    pub fn left(&self) -> f64 {
        self.left.get()
    }

    /// Whether nothing is left after so many more products: then something is not looked for that would have been.
    pub fn is_spent(&self, more: f64) -> bool {
        let spent = self.left.get() < more;
        self.cut_short.set(self.cut_short.get() || spent);
        spent
    }

    /// A search ends before all was looked for.
    pub fn cut_short(&self) {
        self.cut_short.set(true);
    }

    /// Whether something was not looked for.
    pub fn was_cut_short(&self) -> bool {
        self.cut_short.get()
    }
}
