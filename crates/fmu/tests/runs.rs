//! Runs over the functions of the standards: bits, states, parameters, threads.

mod host;

use dbd_fmu::Fmi;
use dbd_fmu::calls::{ERROR, OK};
use dbd_fmu::description::Role;
use dbd_plant::instance::{Instance, Settings};
use host::{scene, unpacked};

const BOTH: [Fmi; 2] = [Fmi::Two, Fmi::Three];

#[test]
fn outputs_have_the_bits_of_a_plain_plant() {
    for fmi in BOTH {
        for (name, precision) in [("3ruu", None), ("cart-pendulum", Some("f32")), ("hexagon", None)]
        {
            let settings = Settings { precision: precision.map(Into::into), ..Settings::default() };
            let fmu = unpacked(scene(name), settings.clone(), fmi);
            let host = fmu.stepping();
            let mut plain = Instance::new(scene(name), settings).unwrap();
            let outputs: Vec<u32> = (0..fmu.description.variables.len() as u32)
                .filter(|row| {
                    matches!(fmu.description.variables[*row as usize].role, Role::Output(..))
                })
                .collect();
            let size = 10.0 * fmu.description.step;
            let mut time = 0.0;
            for _ in 0..30 {
                assert_eq!(host.step(time, size), OK, "{}", host.said());
                time += size;
                plain.advance(10).unwrap();
                let bits =
                    |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
                assert!(bits(host.get_all(&outputs).unwrap()) == bits(plain.values()), "{name}");
            }
            assert_eq!(host.get("time"), plain.time());
            host.free();
        }
    }
}

#[test]
fn a_state_goes_on_in_another_instance_and_back_in_time() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let size = fmu.description.communication_step;
        let one = fmu.host();
        assert_eq!(one.set("body.cart.mass", 1.5), OK);
        assert_eq!(one.initialize(), OK);
        assert_eq!(one.set("drive", 3.0), OK);
        one.run(0, 10, size);
        let state = one.keep().unwrap();
        let bytes = one.bytes(state);
        one.run(10, 30, size);
        let end = one.everything();

        // Rolled back, with the input as it was then.
        assert_eq!(one.set("drive", -8.0), OK);
        assert_eq!(one.go_back(state), OK);
        one.run(10, 30, size);
        assert!(one.everything() == end);

        // In another instance, which was not initialised; parameters come along.
        let other = fmu.host();
        let taken = other.take(&bytes).unwrap();
        assert_eq!(other.go_back(taken), OK, "{}", other.said());
        assert_eq!((other.get("body.cart.mass"), other.get("drive")), (1.5, 3.0));
        other.run(10, 30, size);
        assert!(other.everything() == end);
        assert!(other.bytes(taken) == bytes);

        // A state handle is its own instance's.
        assert_eq!(other.go_back(state), ERROR);
        assert!(other.said().contains("unknown state"), "{}", other.said());
        assert_eq!([one.drop_state(state), one.drop_state(state)], [OK, ERROR]);
        for damaged in [&bytes[..bytes.len() - 1], &[], &[0; 64]] {
            assert_eq!(one.take(damaged), Err(ERROR));
        }
        for byte in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[byte] ^= 4;
            assert_eq!(one.take(&damaged), Err(ERROR), "{byte}");
        }
        let foreign = unpacked(scene("four-bar"), Settings::default(), fmi);
        let foreign = foreign.stepping();
        assert_eq!(foreign.take(&bytes), Err(ERROR));
        assert!(foreign.said().contains("to another FMU"), "{}", foreign.said());
        [one, other, foreign].iter().for_each(host::Host::free);
    }
}

#[test]
fn parameters_are_those_of_the_scene_and_fixed_in_the_end() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let one = fmu.host();
        let before = one.get("energy.total");
        // Before initialisation, and what follows from it.
        assert_eq!(one.set("body.pendulum.mass", 0.46), OK);
        assert_eq!(one.get("body.pendulum.mass"), 0.46);
        assert!(one.get("energy.total") > before);
        assert_eq!(one.initialize(), OK);
        let step = fmu.description.step;
        let changed = scene("cart-pendulum").with("body.pendulum.mass=0.46");
        let settings = Settings { step: Some(step), ..Settings::default() };
        let mut plain = Instance::new(changed, settings).unwrap();
        one.run(0, 20, 10.0 * step);
        plain.advance(200).unwrap();
        assert_eq!(
            one.get("pendulum.y").to_bits(),
            plain.value(plain.output("pendulum.y").unwrap()).to_bits()
        );
        assert_eq!(one.set("body.pendulum.mass", 1.0), ERROR);
        assert!(one.said().contains("body.pendulum.mass is fixed"), "{}", one.said());
        // A reset brings all of it back.
        assert_eq!(one.reset(), OK);
        let fresh = fmu.host();
        assert!(one.everything() == fresh.everything());
        assert_eq!(one.initialize(), OK);
        one.free();
        fresh.free();
    }
}

#[test]
fn what_the_scene_refuses_is_an_error_that_can_be_mended() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let one = fmu.host();
        assert_eq!(one.setup(0.0), OK);
        assert_eq!(one.set("body.cart.mass", -1.0), OK);
        assert_eq!(one.exit_initialization(), ERROR);
        assert!(one.said().contains("must be a finite number > 0 in kg"), "{}", one.said());
        assert_eq!(one.set("body.cart.mass", 1.0), OK);
        assert_eq!(one.exit_initialization(), OK, "{}", one.said());
        one.free();
    }
}

#[test]
fn instances_run_side_by_side_in_threads() {
    for fmi in BOTH {
        let fmu = unpacked(scene("four-bar"), Settings::default(), fmi);
        let size = fmu.description.communication_step;
        let alone = fmu.stepping();
        alone.run(0, 20, size);
        let alone_at_end = alone.everything();
        alone.free();
        let fmu = &fmu;
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..4)
                .map(|_| {
                    scope.spawn(move || {
                        let host = fmu.stepping();
                        host.run(0, 20, size);
                        let end = host.everything();
                        host.free();
                        end
                    })
                })
                .collect();
            for thread in threads {
                assert!(thread.join().unwrap() == alone_at_end);
            }
        });
    }
}

#[test]
fn time_begins_where_the_importer_says() {
    for fmi in BOTH {
        let fmu = unpacked(scene("four-bar"), Settings::default(), fmi);
        let (from_zero, later) = (fmu.stepping(), fmu.host());
        assert_eq!([later.setup(5.0), later.exit_initialization()], [OK; 2]);
        let size = fmu.description.communication_step;
        assert_eq!([from_zero.step(0.0, size), later.step(5.0, size)], [OK; 2]);
        assert_eq!(later.get("time"), 5.0 + size);
        assert_eq!(later.everything()[1..], from_zero.everything()[1..]);
        from_zero.free();
        later.free();
    }
}
