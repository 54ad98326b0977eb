//! Differences of two runs in scheme, precision, step, changed values and the like.

use dbd_plant::time::display;
use serde::Serialize;

use crate::comparison::Comparison;
use crate::recorded::{Head, Kind};

/// A property that differs between A and B.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Differs {
    /// Its name: `scheme`, `step`, `set body.cart.mass` …
    pub what: String,
    /// Its value in A; `None` if not recorded.
    pub a: Option<String>,
    /// Its value in B.
    pub b: Option<String>,
}

/// A property of a run as text.
type Fact = fn(&Head) -> Option<String>;

/// The differences between the two runs, without properties that only one of them records.
#[must_use]
pub fn differs(comparison: &Comparison) -> Vec<Differs> {
    let [a, b] = &comparison.heads;
    let mut all = Vec::new();
    let mut fact = |what: &str, a: Option<String>, b: Option<String>| {
        if a != b {
            all.push(Differs { what: what.to_owned(), a, b });
        }
    };
    let both = |of: Fact| (of(a), of(b));
    let known = |(a, b): (Option<String>, Option<String>)| match (&a, &b) {
        (Some(_), Some(_)) => (a, b),
        _ => (None, None),
    };
    let facts: [(&str, Fact); 6] = [
        ("scene", |head| Some(head.scene.clone())),
        ("scheme", |head| Some(head.scheme.clone())),
        ("precision", |head| Some(head.precision.clone())),
        ("orientation", |head| Some(head.orientation.clone())),
        ("step", |head| Some(display(head.step))),
        ("version", |head| head.version.clone()),
    ];
    for (what, of) in facts {
        let (a, b) = known(both(of));
        fact(what, a, b);
    }
    if a.kind == Kind::Run && b.kind == Kind::Run {
        let newton = |head: &Head| head.newton.map(|newton| newton.to_string());
        fact("newton", newton(a), newton(b));
        let rho = |head: &Head| head.rho.map(|rho| rho.to_string());
        fact("rho", rho(a), rho(b));
        let damping = |head: &Head| head.damping.clone();
        fact("damping", damping(a), damping(b));
        let paths = a.set.iter().chain(&b.set).map(|value| value.path.clone());
        let paths: std::collections::BTreeSet<String> = paths.collect();
        for path in paths {
            let as_in_file = a.set.iter().chain(&b.set).find(|value| value.path == path);
            let as_in_file = as_in_file.and_then(|value| value.before.clone());
            let now = |head: &Head| {
                let own = head.set.iter().find(|value| value.path == path);
                own.map(|value| value.now.clone()).or_else(|| as_in_file.clone())
            };
            fact(&format!("set {path}"), now(a), now(b));
        }
        let (of_a, of_b) = known(both(|head| head.scene_hash.clone()));
        fact("scene's file", of_a, of_b);
        fact("status", a.status.clone(), b.status.clone());
    }
    let every = comparison
        .ends
        .map(|end| end.every.map(|every| display(dbd_plant::time::rounded(every, 12))));
    let [of_a, of_b] = every;
    fact("sampled every", of_a, of_b);
    let [of_a, of_b] = comparison.ends.map(|end| Some(display(end.until)));
    fact("last sample", of_a, of_b);
    all
}

/// The same with equal changes of many values combined in one line.
#[must_use]
pub fn grouped(all: Vec<Differs>) -> Vec<Differs> {
    let mut groups: Vec<(Differs, usize)> = Vec::new();
    let key = |what: &str| Some(what.strip_prefix("set ")?.rsplit_once('.')?.1.to_owned());
    for one in all {
        let own = key(&one.what);
        let like = |(of, _): &&mut (Differs, usize)| {
            own.is_some() && key(&of.what) == own && (&of.a, &of.b) == (&one.a, &one.b)
        };
        match groups.iter_mut().find(like) {
            Some((_, more)) => *more += 1,
            None => groups.push((one, 0)),
        }
    }
    let reported = groups.into_iter().map(|(one, more)| match more {
        0 => one,
        more => Differs { what: format!("{} and {more} more", one.what), ..one },
    });
    reported.collect()
}

impl Differs {
    /// The values of A and of B as text.
    #[must_use]
    pub fn sides(&self) -> [&str; 2] {
        [&self.a, &self.b].map(|side| side.as_deref().unwrap_or("–"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_set_alike_is_told_once() {
        let set = |what: &str, b: &str| Differs {
            what: what.into(),
            a: Some("1".into()),
            b: Some(b.into()),
        };
        let all = vec![
            set("scheme", "2"),
            set("set joint.a.stiffness", "2"),
            set("set joint.b.stiffness", "2"),
            set("set joint.c.stiffness", "3"),
            set("set joint.c.damping", "2"),
            set("step", "2"),
        ];
        let reported: Vec<String> = grouped(all).into_iter().map(|one| one.what).collect();
        let wanted = [
            "scheme",
            "set joint.a.stiffness and 1 more",
            "set joint.c.stiffness",
            "set joint.c.damping",
            "step",
        ];
        assert_eq!(reported, wanted);
    }
}
