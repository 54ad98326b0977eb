//! Windings in rotor axes: locked and steady currents in closed form, order, power balance, stability at long steps.

use dbd_plant::instance::Instance;

use crate::drives::wheel;
use crate::values::Case;
use crate::{instance, reference, value};

const RESISTANCE: f64 = 0.5;
const INDUCTANCES: [f64; 2] = [0.6e-3, 0.9e-3];
const FLUX: f64 = 12e-3;
/// Four pole pairs on a gear of 20.
const POLES: f64 = 80.0;
const VOLTS: [f64; 2] = [-3.0, 14.0];
const WINDING: &str = "winding = { resistance = 0.5, inductance_d = \"0.6 mH\", inductance_q = \"0.9 mH\", \
                       flux = \"12 mV*s\", pole_pairs = 4 }";
const ROTOR: &str =
    "rotor = \"2e-5 kg*m^2\"\nratio = 20\ngear = { stiffness = 200, damping = 0.5 }";

/// A wheel on a machine, with voltages or currents d and q, and its read-outs.
fn machine(mode: &str, keys: &str, [d, q]: [f64; 2]) -> String {
    let drive = format!("mode = \"{mode}\"\n{keys}\nd_input = \"d\"\nvalue = {q}");
    let shown = ["ahead", "rate", "current_d", "current_q"].map(|quantity| {
        format!("[[readout]]\nname = \"{quantity}\"\ntype = \"interaction\"\ntarget = \"motor\"\nquantity = \"{quantity}\"\n")
    });
    let signal = format!("[[input]]\nname = \"d\"\ntype = \"signal\"\nvalue = {d}\n");
    wheel(&drive, "") + &signal + &shown.concat()
}

fn voltage(volts: [f64; 2]) -> String {
    machine("voltage", &format!("{WINDING}\n{ROTOR}"), volts)
}

/// The same with a rotor and a wheel whose rates do not change.
fn turning(speed: f64) -> String {
    voltage(VOLTS)
        .replace("2e-5 kg*m^2", "1e9 kg*m^2")
        .replace("mass = 1", "mass = 1e6")
        .replace("inertia = [0.02, 0.02, 0.02]", "inertia = [1e9, 1e9, 1e9]")
        .replace(
            "position = [0, 0, 0]",
            &format!("position = [0, 0, 0]\nangular_velocity = [0, 0, {speed}]"),
        )
}

fn locked() -> String {
    turning(0.0)
}

/// The currents d and q of a locked rotor: two circuits of resistance and inductance.
fn locked_currents(time: f64) -> [f64; 2] {
    let current =
        |volts: f64, of: f64| volts / RESISTANCE * (1.0 - (-RESISTANCE * time / of).exp());
    [0, 1].map(|axis| current(VOLTS[axis], INDUCTANCES[axis]))
}

const SPEED: f64 = 9.0;

fn driven() -> String {
    turning(SPEED)
}

/// Currents at a constant rate: `R·i_d − ω·L_q·i_q = V_d`, `R·i_q + ω·L_d·i_d = V_q − ω·λ`.
fn steady_currents() -> [f64; 2] {
    let electric = POLES * SPEED;
    let [across_d, across_q] = INDUCTANCES.map(|of| electric * of);
    let [of_d, of_q] = [VOLTS[0], VOLTS[1] - electric * FLUX];
    let divisor = RESISTANCE * RESISTANCE + across_d * across_q;
    [
        (RESISTANCE * of_d + across_q * of_q) / divisor,
        (RESISTANCE * of_q - across_d * of_d) / divisor,
    ]
}

fn effort([d, q]: [f64; 2]) -> f64 {
    1.5 * POLES * (FLUX + (INDUCTANCES[0] - INDUCTANCES[1]) * d) * q
}

fn currents(run: &Instance) -> [f64; 2] {
    ["current_d", "current_q"].map(|name| value(run, name))
}

fn currents_at(text: &str, step: f64, time: f64, precision: &str) -> [f64; 2] {
    let mut run = instance(text, step, precision);
    run.advance_to(time).unwrap();
    currents(&run)
}

fn order(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// Both axes of a locked rotor, of second order; at steps of many time constants they are where they end.
#[test]
fn a_locked_rotor_has_two_circuits() {
    let exact = locked_currents(2e-3);
    let steps = [1e-3, 5e-4, 2.5e-4, 1.25e-4];
    for axis in [0, 1] {
        let errors =
            steps.map(|step| (currents_at(&locked(), step, 2e-3, "f64")[axis] - exact[axis]).abs());
        assert!((1.9..2.2).contains(&order(&errors)), "{axis}: {errors:?}");
        assert!(errors[3] < 2e-3 * exact[axis].abs(), "{axis}: {errors:?}");
    }
    for (precision, near) in [("f64", 1e-9), ("f32", 1e-5), ("fixed", 1e-5)] {
        let found = currents_at(&locked(), 0.05, 1.0, precision);
        for (found, volts) in found.iter().zip(VOLTS) {
            assert!((found - volts / RESISTANCE).abs() < near * 30.0, "{precision}: {found}");
        }
    }
}

/// At a constant rate, whatever the step is of the time constants of 1.2 ms and 1.8 ms.
#[test]
fn a_constant_rate_has_its_steady_currents() {
    let exact = steady_currents();
    for (precision, near) in [("f64", 1e-6), ("f32", 3e-4), ("fixed", 3e-4)] {
        for step in [1e-4, 1e-3, 1e-2] {
            let mut run = instance(&driven(), step, precision);
            run.advance_to(2.0).unwrap();
            let found = currents(&run);
            for axis in [0, 1] {
                let off = (found[axis] - exact[axis]).abs();
                assert!(off < near, "{precision} {step}: {found:?} {exact:?}");
            }
            let torque = value(&run, "effort");
            assert!((torque - effort(exact)).abs() < 10.0 * near, "{precision} {step}: {torque}");
        }
    }
}

/// `[angle, rate, ahead, rotor's rate, i_d, i_q]` by a reference of its own.
fn known(time: f64) -> Vec<[f64; 6]> {
    let (j, m, k, c) = (0.02, 8e-3, 200.0, 0.5);
    let [of_d, of_q] = INDUCTANCES;
    reference([0.0; 6], time, |&[_, w, ahead, v, d, q], _| {
        let (pull, electric) = (k * ahead + c * (v - w), POLES * v);
        let rise_d = (VOLTS[0] - RESISTANCE * d + electric * of_q * q) / of_d;
        let rise_q = (VOLTS[1] - RESISTANCE * q - electric * (of_d * d + FLUX)) / of_q;
        [w, pull / j, v - w, (effort([d, q]) - pull) / m, rise_d, rise_q]
    })
}

/// A start from rest with rotor, gear and wheel.
#[test]
fn a_machine_with_rotor_and_gear_is_of_second_order() {
    let known = known(0.15);
    let names = ["angle", "speed", "ahead", "rate", "current_d", "current_q"];
    let errors = [500e-6, 250e-6, 125e-6].map(|step| {
        let mut run = instance(&voltage(VOLTS), step, "f64");
        let mut most = [0.0_f64; 6];
        for (ms, row) in known.iter().enumerate() {
            run.advance_to((ms + 1) as f64 * 1e-3).unwrap();
            for (i, name) in names.iter().enumerate() {
                most[i] = most[i].max((value(&run, name) - row[i]).abs());
            }
        }
        most
    });
    for (i, name) in names.iter().enumerate().filter(|(i, _)| *i != 1) {
        let of = errors.map(|errors| errors[i]);
        println!("{name}: {of:?}, order {}", order(&of));
        assert!((1.8..2.4).contains(&order(&of)), "{name}: {of:?}");
    }
    assert!(errors[2][0] < 2e-5, "{errors:?}");
}

/// `1.5·(V_d·i_d + V_q·i_q)` heats the windings, magnetises them, and drives; what drives, the balance of the run counts.
#[test]
fn the_power_of_the_windings_balances() {
    let errors = [200e-6, 100e-6, 50e-6].map(|step| {
        let text = voltage(VOLTS).replace("damping = 0.5", "damping = 0");
        let mut run = instance(&text, step, "f64");
        let powers = |run: &Instance| {
            let [d, q] = currents(run);
            let given = 1.5 * (VOLTS[0] * d + VOLTS[1] * q);
            let heat = 1.5 * RESISTANCE * (d * d + q * q);
            [given, heat, value(run, "effort") * value(run, "rate")]
        };
        let (mut before, mut work) = (powers(&run), [0.0; 3]);
        for _ in 0..(0.1 / step).round() as u32 {
            run.advance(1).unwrap();
            let now = powers(&run);
            for i in 0..3 {
                work[i] += 0.5 * step * (before[i] + now[i]);
            }
            before = now;
        }
        let [d, q] = currents(&run);
        let magnetic = 0.75 * (INDUCTANCES[0] * d * d + INDUCTANCES[1] * q * q);
        let [given, heat, driven] = work;
        let windings = (given - heat - driven - magnetic) / given;
        [windings.abs(), (driven - value(&run, "energy.total")).abs() / given]
    });
    println!("{errors:?}");
    for i in [0, 1] {
        let of = errors.map(|errors| errors[i]);
        assert!(of[2] < 2e-4 && (1.6..2.6).contains(&order(&of)), "{i}: {of:?}");
    }
}

/// Shorted, it brakes at any step: rotor, wheel and windings together gain no energy.
#[test]
fn a_shorted_machine_makes_no_energy() {
    for resistance in ["0.5", "1e-6", "100"] {
        for (precision, near) in [("f64", 1e-12), ("f32", 1e-5), ("fixed", 1e-5)] {
            let text = voltage([0.0; 2])
                .replace("resistance = 0.5", &format!("resistance = {resistance}"))
                .replace("stiffness = 200, damping = 0.5", "stiffness = 1e-6, damping = 0")
                .replace("mass = 1", "mass = 1e3")
                .replace(
                    "position = [0, 0, 0]",
                    "position = [0, 0, 0]\nangular_velocity = [0, 0, 180]",
                );
            let mut run = instance(&text, 5e-3, precision);
            let energy = |run: &Instance| {
                let ([d, q], rate) = (currents(run), value(run, "rate"));
                0.5 * 8e-3 * rate * rate + 0.75 * (INDUCTANCES[0] * d * d + INDUCTANCES[1] * q * q)
            };
            run.advance(1).unwrap();
            let mut last = energy(&run);
            for step in 0..400 {
                run.advance(1).unwrap();
                let now = energy(&run);
                // The weak gear gives a little: 1 µN·m/rad over the revolutions so far.
                let given = 1e-6 * run.time() * 180.0 * 5e-3 * 180.0;
                assert!(
                    now <= last * (1.0 + near) + given,
                    "{resistance} {precision} {step}: {now} {last}"
                );
                last = now;
            }
        }
    }
}

/// Currents as inputs, within their bound, with and without a lag.
#[test]
fn currents_as_inputs_give_their_effort() {
    let of = |winding: &str, more: &str, given: [f64; 2]| {
        let text = machine("current", &format!("{winding}\n{ROTOR}\n{more}"), given);
        let mut run = instance(&text, 5e-4, "f64");
        run.advance_to(0.05).unwrap();
        (value(&run, "effort"), currents(&run))
    };
    let salient = "winding = { inductance_d = \"0.6 mH\", inductance_q = \"0.9 mH\", flux = \"12 mV*s\", \
                   pole_pairs = 4, most_current = 13 }";
    let given = [-3.0, 4.0];
    for more in ["", "lag = \"1 ms\"", "friction = { viscous = 1e-6, coulomb = 1e-4 }"] {
        let (torque, found) = of(salient, more, given);
        assert!((torque - effort(given)).abs() < 1e-9, "{more}: {torque}");
        assert_eq!(found, given, "{more}");
    }
    // Both by the same part, 13 of 26 A.
    let (torque, found) = of(salient, "", [-10.0, 24.0]);
    assert!((found[0] + 5.0).abs() < 1e-12 && (found[1] - 12.0).abs() < 1e-12, "{found:?}");
    assert!((torque - effort([-5.0, 12.0])).abs() < 1e-9, "{torque}");
    let round = "winding = { flux = \"12 mV*s\", pole_pairs = 4 }";
    let (torque, _) = of(round, "", given);
    assert!((torque - 1.5 * POLES * FLUX * 4.0).abs() < 1e-9, "{torque}");
}

/// Friction of the shaft holds a machine exactly; its windings then are two circuits, to the order of the step.
#[test]
fn friction_holds_a_machine() {
    let keys =
        |coulomb: &str| format!("{WINDING}\n{ROTOR}\nfriction = {{ coulomb = \"{coulomb}\" }}");
    let mut run = instance(&machine("voltage", &keys("3 N*m"), VOLTS), 2e-4, "f64");
    run.advance_to(0.1).unwrap();
    assert_eq!((value(&run, "rate"), value(&run, "angle")), (0.0, 0.0));
    let exact = VOLTS.map(|volts| volts / RESISTANCE);
    for (found, exact) in currents(&run).iter().zip(exact) {
        assert!((found - exact).abs() < 1e-3, "{found} {exact}");
    }
    // Less than the effort of the windings at rest: it runs at a rate where they balance.
    let mut run = instance(&machine("voltage", &keys("50 mN*m"), VOLTS), 2e-4, "f64");
    run.advance_to(3.0).unwrap();
    let torque = value(&run, "effort");
    assert!((torque - 20.0 * 0.05).abs() < 1e-6, "{torque}");
    assert!(value(&run, "speed") > 1.0, "{}", value(&run, "speed"));
}

#[test]
fn a_snapshot_keeps_both_currents() {
    let text = voltage(VOLTS).replace("pole_pairs = 4", "pole_pairs = 4, most_current = 20");
    for precision in ["f64", "f32", "fixed"] {
        let mut one = instance(&text, 1e-4, precision);
        let inputs = ["d", "motor"].map(|name| one.input(name).unwrap());
        let controlled = |run: &mut Instance, steps: u32| {
            for step in 0..steps {
                let phase = 0.02 * f64::from(step);
                for (input, volts) in inputs.iter().zip([-3.0 * phase.cos(), 14.0 * phase.sin()]) {
                    run.set_input(*input, volts).unwrap();
                }
                run.advance(1).unwrap();
            }
        };
        controlled(&mut one, 1000);
        assert_eq!(one.plant().evaluations(), 1001, "{precision}");
        let saved = one.save().unwrap();
        let mut other = instance(&text, 1e-4, precision);
        other.restore(&saved).unwrap();
        assert_eq!(currents(&one), currents(&other), "{precision}");
        controlled(&mut one, 500);
        controlled(&mut other, 500);
        assert_eq!(one.hash(), other.hash(), "{precision}");
    }
}

/// The rows of the page.
pub(crate) fn cases() -> Vec<Case> {
    let case = |what, unit, exact, step, near, found: Box<dyn Fn(f64) -> f64>| Case {
        element: "hinge-drive-dq",
        what,
        unit,
        exact,
        step,
        near,
        found,
    };
    let last = known(0.1).last().map_or([0.0; 6], |row| *row);
    vec![
        case(
            "current q of a locked rotor after 2 ms",
            "A",
            locked_currents(2e-3)[1],
            5e-4,
            1e-3,
            Box::new(|h| currents_at(&locked(), h, 2e-3, "f64")[1]),
        ),
        case(
            "current d at a constant rate",
            "A",
            steady_currents()[0],
            1e-2,
            1e-6,
            Box::new(|h| currents_at(&driven(), h, 2.0, "f64")[0]),
        ),
        case(
            "angle 0.1 s after −3 V on d and 14 V on q",
            "rad",
            last[0],
            5e-4,
            1e-4,
            Box::new(|h| crate::values::at(&voltage(VOLTS), h, 0.1, "angle")),
        ),
    ]
}
