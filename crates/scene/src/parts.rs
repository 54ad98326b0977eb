//! Connected components (union-find).

/// Items that start separate and are joined in pairs.
pub(crate) struct Parts {
    /// Leads, in one or more steps, to the lowest item of its component.
    towards: Vec<usize>,
}

impl Parts {
    /// The given number of separate items.
    pub(crate) fn apart(count: usize) -> Self {
        Self { towards: (0..count).collect() }
    }

    /// The lowest item of an item's component.
    pub(crate) fn first(&mut self, mut thing: usize) -> usize {
        while self.towards[thing] != thing {
            self.towards[thing] = self.towards[self.towards[thing]];
            thing = self.towards[thing];
        }
        thing
    }

    /// Joins the components of two items; returns whether they were separate.
    pub(crate) fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.first(a), self.first(b));
        self.towards[a.max(b)] = a.min(b);
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_within_a_part_closes_a_loop() {
        let mut parts = Parts::apart(6);
        assert!(parts.join(5, 4) && parts.join(3, 4) && parts.join(0, 1));
        assert!(!parts.join(3, 5));
        assert_eq!([0, 1, 2, 3, 4, 5].map(|i| parts.first(i)), [0, 0, 2, 3, 3, 3]);
        assert!(parts.join(1, 5));
        assert_eq!((parts.first(4), parts.first(2)), (0, 2));
    }
}
