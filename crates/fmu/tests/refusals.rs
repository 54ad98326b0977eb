//! What is wrong is told, with words, and the host lives on.

#![allow(unsafe_code, reason = "a caller in C")]

mod host;

use std::ffi::{CStr, c_void};
use std::fs;
use std::ptr::{null, null_mut};

use dbd_fmu::calls::{ERROR, OK};
use dbd_fmu::{Fmi, fmi2, fmi3, fmi3_absent};
use dbd_plant::instance::{Blueprint, Settings};
use host::{Host, scene, unpacked};

const BOTH: [Fmi; 2] = [Fmi::Two, Fmi::Three];

#[track_caller]
fn says(host: &Host<'_>, words: &str) {
    assert!(host.said().contains(words), "{}", host.said());
}

#[test]
fn a_wrong_token_and_damaged_resources_give_no_instance() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let refused = |token: &str, words: &str| {
            let host = fmu.try_host(token);
            assert!(host.handle.is_null());
            says(&host, words);
        };
        refused("0123456789abcdef", "the token 0123456789abcdef does not match these resources");
        let file = |name: &str| fmu.folder.path().join(name);
        let scene = fs::read_to_string(file("scene.toml")).unwrap();
        let plan = fs::read_to_string(file("scene.json")).unwrap();
        fs::write(file("scene.toml"), scene.replacen("mass = 0.94", "mass = 0.95", 1)).unwrap();
        refused(&fmu.token, "does not match these resources");
        fs::write(file("scene.toml"), scene.replacen("mass = 0.94", "mass = -1", 1)).unwrap();
        refused(&fmu.token, "cart-pendulum.toml:");
        fs::write(file("scene.toml"), b"\xff\xfe").unwrap();
        refused(&fmu.token, "cannot read scene.toml of the FMU's resources");
        fs::remove_file(file("scene.toml")).unwrap();
        refused(&fmu.token, "cannot read scene.toml of the FMU's resources");
        fs::write(file("scene.toml"), &scene).unwrap();
        for (text, words) in [
            (&plan[..plan.len() / 2], "scene.json of the FMU's resources is damaged"),
            (&plan.replace("\"scheme\"", "\"skeme\""), "unknown field `skeme`"),
            (&plan.replace("\"scheme\": null", "\"scheme\": \"euler\""), "no scheme `euler`"),
        ] {
            fs::write(file("scene.json"), text).unwrap();
            refused(&fmu.token, words);
        }
        fs::write(file("scene.json"), &plan).unwrap();
        fmu.host().free();
    }
}

#[test]
fn values_that_are_none_are_refused_and_change_nothing() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let host = fmu.host();
        assert_eq!(host.set("body.cart.mass", f64::NAN), ERROR);
        says(&host, "the parameter `body.cart.mass` cannot be set to NaN");
        assert_eq!(host.initialize(), OK);
        let before = host.everything();
        for value in [f64::NAN, f64::INFINITY] {
            assert_eq!(host.set("drive", value), ERROR);
            says(&host, "the input `drive` cannot take");
        }
        assert_eq!(host.set("cart.x", 1.0), ERROR);
        says(&host, "cart.x is computed, not set");
        assert_eq!(host.set_by(70_000, 1.0), ERROR);
        says(&host, "no variable with the value reference 70000");
        assert_eq!(host.get_all(&[u32::MAX]), Err(ERROR));
        assert!(host.everything() == before);
        host.free();
    }
}

#[test]
fn a_step_that_is_no_multiple_is_an_error_with_the_remedy() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let (host, step) = (fmu.stepping(), fmu.description.step);
        assert_eq!(host.step(0.0, 10.0 * step), OK);
        let before = host.everything();
        assert_eq!(host.step(10.0 * step, 2.5 * step), ERROR);
        says(
            &host,
            "a communication step of 0.00125 s is not a multiple of the plant's step of 500us; set the importer's \
             communication step (output interval) to 0.001 s or 0.0015 s, or make the FMU with a step that divides it: \
             host-sim fmu --step 0.000416666666667",
        );
        if fmi == Fmi::Two {
            let (mut status, mut time, mut ended, mut text) = (0, 0.0, 7, null());
            // SAFETY: places for what is written; the text lives until the next step.
            unsafe {
                assert_eq!(fmi2::fmi2GetStatus(host.handle, 0, &mut status), OK);
                assert_eq!(fmi2::fmi2GetStringStatus(host.handle, 1, &mut text), OK);
                assert_eq!(fmi2::fmi2GetRealStatus(host.handle, 2, &mut time), OK);
                assert_eq!(fmi2::fmi2GetBooleanStatus(host.handle, 3, &mut ended), OK);
                assert_eq!(fmi2::fmi2GetIntegerStatus(host.handle, 2, &mut status), ERROR);
                assert!(CStr::from_ptr(text).to_str().unwrap().contains("multiple"));
            }
            assert_eq!((status, time, ended), (ERROR, 10.0 * step, 0));
        }
        for (point, size) in [
            (10.0 * step, -step),
            (10.0 * step, f64::NAN),
            (0.0, step),
            (11.0 * step, step),
            (f64::INFINITY, step),
        ] {
            assert_eq!(host.step(point, size), ERROR, "{point} {size}");
        }
        assert!(host.everything() == before);
        assert_eq!(host.step(10.0 * step, step), OK, "{}", host.said());
        host.free();
    }
}

#[test]
fn an_interval_that_does_not_fit_moves_nothing_until_one_does() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let (host, step) = (fmu.stepping(), fmu.description.step);
        let before = host.everything();
        // Neither 0 s nor a step of 0 s is a remedy.
        assert_eq!(host.step(0.0, 0.3 * step), ERROR);
        says(&host, "to 0.0005 s, or make the FMU");
        for interval in [1.0 / 60.0, 1e-3 / 3.0, 1.7 * step] {
            assert_eq!(host.step(0.0, interval), ERROR, "{interval}");
            assert!(host.everything() == before);
            // The step that the message names divides the interval.
            let said = host.said();
            let named: f64 = said.rsplit("--step ").next().unwrap().trim().parse().unwrap();
            let settings = Settings { step: Some(named), ..Settings::default() };
            let remade = unpacked(scene("cart-pendulum"), settings, fmi);
            let other = remade.stepping();
            assert_eq!(other.step(0.0, interval), OK, "{}", other.said());
            other.free();
        }
        host.free();
    }
}

#[test]
fn a_plant_that_failed_goes_on_after_a_reset_or_with_a_state() {
    // A spring far too stiff for the step.
    let text = "name = \"spring\"\nduration = 1.0\nstep = 0.01\n[[body]]\nname = \"weight\"\nmass = 1.0\n\
                inertia = [0.01, 0.01, 0.01]\nposition = [0, -1.0, 0]\n[[tsda]]\nbetween = [\"world\", \"weight\"]\n\
                points = [[0, 0, 0], [0, 0, 0]]\nstiffness = 1e9\nfree_length = 0.9\n";
    for fmi in BOTH {
        let fmu = unpacked(Blueprint::new("spring.toml", text), Settings::default(), fmi);
        let host = fmu.stepping();
        let state = host.keep().unwrap();
        let fail = || {
            let failed = (0..400).map(|n| host.step(f64::from(n) * 0.01, 0.01)).find(|s| *s != OK);
            assert_eq!(failed, Some(ERROR));
            says(&host, "in step ");
        };
        fail();
        assert_eq!(host.step(host.get("time"), 0.01), ERROR);
        assert_eq!(host.keep(), Err(ERROR));
        assert_eq!(host.go_back(state), OK, "{}", host.said());
        assert_eq!(host.step(0.0, 0.01), OK);
        assert_eq!([host.reset(), host.initialize()], [OK; 2]);
        fail();
        host.free();
    }
}

#[test]
fn calls_out_of_order_are_told() {
    for fmi in BOTH {
        let fmu = unpacked(scene("four-bar"), Settings::default(), fmi);
        let host = fmu.host();
        assert_eq!(host.step(0.0, 0.001), ERROR);
        says(&host, "the FMU is not initialised yet");
        assert_eq!([host.exit_initialization(), host.terminate()], [ERROR; 2]);
        assert_eq!(host.initialize(), OK);
        assert_eq!(host.initialize(), ERROR);
        says(&host, "already initialised");
        assert_eq!(host.terminate(), OK);
        assert_eq!(host.set("body.crank.mass", 1.0), ERROR);
        says(&host, "terminated");
        assert!(host.get("crank.x").is_finite());
        assert_eq!([host.reset(), host.initialize()], [OK; 2]);
        assert_eq!(host.setup(f64::NAN), ERROR);
        host.free();
    }
}

#[test]
fn handles_that_are_none_are_told() {
    let fmu = unpacked(scene("four-bar"), Settings::default(), Fmi::Two);
    let host = fmu.stepping();
    let mut value = 0.0;
    let freed = {
        let other = fmu.stepping();
        other.free();
        other.handle
    };
    let foreign: *mut c_void = (&raw mut value).cast();
    // SAFETY: no handle is looked at as a pointer, and null pointers are told.
    unsafe {
        for handle in [null_mut(), freed, foreign] {
            assert_eq!(fmi2::fmi2DoStep(handle, 0.0, 0.001, 0), ERROR);
            assert_eq!(fmi2::fmi2GetReal(handle, &0, 1, &mut value), ERROR);
            assert_eq!(fmi3::fmi3Reset(handle), ERROR);
            fmi2::fmi2FreeInstance(handle);
            fmi3::fmi3FreeInstance(handle);
        }
        let handle = host.handle;
        assert_eq!(fmi2::fmi2GetReal(handle, null(), 1, &mut value), ERROR);
        says(&host, "fmi2GetReal: null pointer");
        assert_eq!(fmi2::fmi2GetReal(handle, &0, 1, null_mut()), ERROR);
        assert_eq!(fmi2::fmi2GetReal(handle, null(), 0, null_mut()), OK);
        assert_eq!(fmi2::fmi2SetReal(handle, &0, 1, null()), ERROR);
        assert_eq!(fmi2::fmi2GetFMUstate(handle, null_mut()), ERROR);
        assert_eq!(fmi2::fmi2SetFMUstate(handle, null_mut()), ERROR);
        assert_eq!(fmi2::fmi2FreeFMUstate(handle, null_mut()), OK);
        assert_eq!(fmi2::fmi2DeSerializeFMUstate(handle, null(), 9, &mut null_mut()), ERROR);
        assert_eq!(fmi2::fmi2SetDebugLogging(handle, 1, 1, &c"logAll".as_ptr()), ERROR);
        assert_eq!(fmi2::fmi2SetDebugLogging(handle, 1, 1, &c"logStatusError".as_ptr()), OK);
        let none = null();
        assert!(fmi2::fmi2Instantiate(none, 1, none, none, null(), 0, 0).is_null());
    }
    host.free();
}

#[test]
fn what_there_is_not_is_an_error_in_words() {
    let two = unpacked(scene("four-bar"), Settings::default(), Fmi::Two);
    let three = unpacked(scene("four-bar"), Settings::default(), Fmi::Three);
    let (two, three) = (two.stepping(), three.stepping());
    // SAFETY: these do not look at their pointers.
    unsafe {
        assert_eq!(fmi2::fmi2SetTime(two.handle, 0.0), ERROR);
        says(&two, "fmi2SetTime: not supported");
        assert_eq!(fmi2::fmi2CancelStep(two.handle), ERROR);
        assert_eq!(fmi2::fmi2GetInteger(two.handle, &0, 1, &mut 0), ERROR);
        says(&two, "all variables of this FMU are Real");
        assert_eq!(fmi2::fmi2GetInteger(two.handle, null(), 0, null_mut()), OK);
        let handle = three.handle;
        assert_eq!(fmi3_absent::fmi3GetNumberOfVariableDependencies(handle, 0, &mut 0), ERROR);
        says(&three, "fmi3GetNumberOfVariableDependencies: not supported");
        assert_eq!(fmi3_absent::fmi3GetFloat32(handle, &0, 1, &mut 0.0, 1), ERROR);
        says(&three, "all variables of this FMU are Float64");
        assert_eq!(fmi3::fmi3GetFloat64(handle, &0, 1, &mut 0.0, 2), ERROR);
        says(&three, "2 values for 1 variables");
    }
    two.free();
    three.free();
}
