//! The smaller examples of the kernel and of `host-sim` come to what their pages say.

#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../../host-sim/examples/coupler_curve.rs"]
mod coupler_curve;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../../kernel/examples/hand_over.rs"]
mod hand_over;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../../kernel/examples/lift.rs"]
mod lift;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../../kernel/examples/own_scheme.rs"]
mod own_scheme;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../../kernel/examples/pendulum.rs"]
mod pendulum;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../../host-sim/examples/stiffness.rs"]
mod stiffness;

use dbd_tests::page::{block, figure, table};

#[test]
fn the_small_examples_do_what_they_say() {
    let (period, theory) = (pendulum::period().unwrap(), pendulum::theory());
    // Its joint gives way a little: slower than the rigid rod, by less than a part in a thousand.
    assert!(period > theory && period < 1.001 * theory, "{period} {theory}");

    let [coarse, fine] = [100, 200].map(|steps| own_scheme::error(steps).unwrap());
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.05, "{order}");

    let [whole, handed] = hand_over::hashes().unwrap();
    assert_eq!(whole, handed);

    let off = lift::off_target().unwrap();
    assert!(off < 1e-4, "{off}");

    let stiffnesses = [1e6, 1e7, 1e8, 1e9];
    let swept = stiffness::sweep(&stiffnesses).unwrap();
    for pair in swept.windows(2) {
        // The step follows the root of the stiffness, and what is off falls with it.
        let ratio = pair[0][0] / pair[1][0];
        assert!((ratio / 10_f64.sqrt() - 1.0).abs() < 0.1, "{swept:?}");
        assert!(pair[0][1] > pair[1][1], "{swept:?}");
    }

    let [width, height, force] = coupler_curve::curve().unwrap();
    assert!(width > 0.1 && height > 0.05 && force > 1e3, "{width} {height} {force}");

    let row = |command: &str, shows: &str, comes_to: String| {
        vec![format!("`cargo run --release {command}`"), shows.to_owned(), comes_to]
    };
    let rows = [
        row(
            "-p dbd-kernel --example pendulum",
            "a const model written by hand, stepped and read",
            format!("a period of {period:.4} s; a rigid rod's is {theory:.4} s"),
        ),
        row(
            "-p dbd-kernel --example own_scheme",
            "a scheme of your own",
            format!("order {order:.2}"),
        ),
        row(
            "-p dbd-kernel --example hand_over",
            "a snapshot, taken up by another plant",
            format!("`{whole:016x}` in one go and handed over"),
        ),
        row(
            "-p dbd-kernel --features heapless --example lift",
            "a model built at run time, an input, a controller",
            format!("{} m from its target", figure(off, 1)),
        ),
        row(
            "--example stiffness",
            "a parameter swept by a program",
            format!(
                "from 1e6 to 1e9 N/m: steps of {} to {} µs",
                figure(1e6 * swept[0][0], 2),
                figure(1e6 * swept[3][0], 2)
            ),
        ),
        row(
            "--example coupler_curve",
            "a read-out that the scene does not have",
            format!("{width:.2} m by {height:.2} m, up to {} kN", figure(1e-3 * force, 2)),
        ),
    ];
    block("docs/examples.md", "small examples", &table(&["example", "shows", "comes to"], &rows));
}
