//! Elements that real plants have against closed forms and references of their own: stops, tables, friction, contact,
//! drives. The page `docs/elements.md` has the values.

mod axes;
mod bushing;
mod chains;
mod contacts;
mod costs;
mod couplings;
mod creep;
mod driven;
mod drives;
mod examples;
mod gravity;
mod loaded;
mod mounts;
mod relaxing;
mod shaft;
mod slides;
mod soft;
mod values;
mod winches;

use dbd_plant::instance::{Blueprint, Instance, Settings};

fn instance(text: &str, step: f64, precision: &str) -> Instance {
    let settings =
        Settings { step: Some(step), precision: Some(precision.to_owned()), ..Settings::default() };
    Instance::new(Blueprint::new("drives.toml", text), settings)
        .unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn value(instance: &Instance, name: &str) -> f64 {
    instance.value(instance.output(name).unwrap())
}

/// States at every millisecond of x' = f(x), by the classical method of fourth order in steps of 1 µs.
fn reference<const N: usize>(
    mut x: [f64; N],
    time: f64,
    f: impl Fn(&[f64; N], f64) -> [f64; N],
) -> Vec<[f64; N]> {
    let h = 1e-6;
    let moved = |x: &[f64; N], k: &[f64; N], h: f64| {
        let mut to = *x;
        to.iter_mut().zip(k).for_each(|(x, k)| *x += h * k);
        to
    };
    let mut rows = Vec::new();
    for step in 0..(time * 1e6).round() as u32 {
        let t = f64::from(step) * h;
        let k1 = f(&x, t);
        let k2 = f(&moved(&x, &k1, 0.5 * h), t + 0.5 * h);
        let k3 = f(&moved(&x, &k2, 0.5 * h), t + 0.5 * h);
        let k4 = f(&moved(&x, &k3, h), t + h);
        for i in 0..N {
            x[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
        if (step + 1) % 1000 == 0 {
            rows.push(x);
        }
    }
    rows
}
