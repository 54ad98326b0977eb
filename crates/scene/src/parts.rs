//! Which of a number of things hang together.

/// Things that are apart at first and are joined by pairs.
pub(crate) struct Parts {
    /// Leads, in one step or more, to the lowest thing of its part.
    towards: Vec<usize>,
}

impl Parts {
    /// So many things, all apart.
    pub(crate) fn apart(count: usize) -> Self {
        Self { towards: (0..count).collect() }
    }

    /// The lowest thing of a thing's part.
    pub(crate) fn first(&mut self, mut thing: usize) -> usize {
        while self.towards[thing] != thing {
            self.towards[thing] = self.towards[self.towards[thing]];
            thing = self.towards[thing];
        }
        thing
    }

    /// Joins the parts of two things; whether they were apart.
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
