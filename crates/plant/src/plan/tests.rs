//! Valid and rejected plans.

use super::*;

fn given(step: f64, duration: f64, every: Option<f64>) -> Result<Plan, PlanError> {
    plan(&Request { step: StepRequest::Given(step), duration, every })
}

fn ours(limit: f64, duration: f64, every: Option<f64>) -> Result<Plan, PlanError> {
    plan(&Request { step: StepRequest::AtMost(limit), duration, every })
}

#[test]
fn decimal_times_that_are_no_binary_multiples_count_as_whole() {
    let plan = given(2e-5, 0.5, Some(1e-3)).unwrap();
    assert_eq!((plan.step.to_bits(), plan.steps, plan.stride), (2e-5_f64.to_bits(), 25_000, 50));
    assert_eq!(plan.samples(), 501);
    let plan = given(1e-6, 3.0, Some(0.3)).unwrap();
    assert_eq!((plan.steps, plan.stride), (3_000_000, 300_000));
    // 0.1 + 0.2 is not 0.3.
    assert_eq!(given(0.1, 0.1 + 0.2, None).unwrap().steps, 3);
    assert_eq!(given(0.5, 0.5, None).unwrap().samples(), 2);
}

#[test]
fn a_duration_that_is_no_multiple_of_every_ends_with_a_shorter_interval() {
    let plan = given(0.1, 1.0, Some(0.3)).unwrap();
    assert_eq!((plan.steps, plan.stride, plan.samples()), (10, 3, 5));
}

#[test]
fn a_given_step_that_does_not_fit_is_refused_with_two_that_do() {
    let cases = [
        (3e-5, 0.5, None),
        (3e-5, 0.5, Some(1e-3)),
        (7.3e-4, 0.5, Some(1e-3)),
        (2e-4, 0.5, Some(1.1e-3)),
        (0.4, 1.0, Some(0.3)),
        (1.0 / 7.1, 1.0, None),
    ];
    for (step, duration, every) in cases {
        let Err(PlanError::Multiple { steps, .. }) = given(step, duration, every) else {
            panic!("{step} {duration} {every:?}");
        };
        assert_eq!(steps.len(), 2, "{step}");
        for fitting in &steps {
            let shown: crate::time::Time = display(*fitting).parse().unwrap();
            let plan = given(shown.seconds(), duration, every).unwrap();
            assert_eq!(plan.step.to_bits(), fitting.to_bits());
        }
    }
    let Err(PlanError::Multiple { steps, .. }) = given(3e-5, 0.5, Some(1e-3)) else {
        panic!();
    };
    assert_eq!(steps, [1e-3 / 33.0, 1e-3 / 34.0]);
}

#[test]
fn where_only_every_does_not_fit_intervals_are_named_too() {
    let Err(PlanError::Multiple { intervals, .. }) = given(2e-5, 0.5, Some(1.234e-3)) else {
        panic!();
    };
    assert_eq!(intervals, [1.22e-3, 1.24e-3]);
    for every in intervals {
        assert!(given(2e-5, 0.5, Some(every)).is_ok());
    }
}

#[test]
fn a_step_longer_than_the_duration_is_refused_with_shorter_ones() {
    let Err(PlanError::Multiple { steps, .. }) = given(0.7, 0.5, None) else { panic!() };
    assert_eq!(steps, [0.5, 0.25]);
    let every = 0.6;
    assert_eq!(given(0.1, 0.5, Some(every)), Err(PlanError::Every { duration: 0.5, every }));
}

#[test]
fn our_step_is_shortened_to_fit() {
    let plan = ours(2.9e-4, 0.5, Some(1e-3)).unwrap();
    assert_eq!((plan.step, plan.stride, plan.steps), (1e-3 / 4.0, 4, 2000));
    // 0.3 s and 1 s have 0.1 s in common, of which 0.05 s is the longest part that divides 1 s and is round.
    let plan = ours(1.0, 1.0, Some(0.3)).unwrap();
    assert_eq!((plan.step, plan.stride, plan.steps), (0.05, 6, 20));
    let plan = ours(0.04, 1.0, Some(0.3)).unwrap();
    assert_eq!((plan.step, plan.stride, plan.steps), (0.025, 12, 40));
    let plan = ours(3e-4, 0.5, None).unwrap();
    assert_eq!((plan.steps, plan.step), (2000, 250e-6));
    assert_eq!(ours(f64::INFINITY, 2.0, None).unwrap().steps, 1);
}

#[test]
fn a_default_step_is_round_and_divides_common_intervals() {
    let round = |limit, duration, every| ours(limit, duration, every).unwrap().step;
    for (limit, step) in [
        (51.4e-6, 50e-6),
        (39.1e-6, 25e-6),
        (23e-6, 20e-6),
        (20e-6, 20e-6),
        (9.99e-6, 8e-6),
        (0.17, 0.125),
    ] {
        assert_eq!(round(limit, 10.0, None), step);
        assert_eq!(round(limit, 10.0, Some(0.25)), step);
    }
    // Beyond 1 ms it divides 1 s.
    assert_eq!(round(4.9e-3, 2.0, None), 4e-3);
    // 1/60 s has round parts, 1/3 s has none.
    assert_eq!(round(1.0, 1.0 / 3.0, None), 1.0 / 3.0);
    assert_eq!(round(3e-5, 0.6, Some(0.011)), 25e-6);
    let mut limit = 1e-6;
    while limit < 1e-3 {
        let step = round(limit, 1.0, None);
        assert!(
            step <= limit && 2.0 * step >= limit && whole(1e-3 / step).is_some(),
            "{limit} {step}"
        );
        limit *= 1.07;
    }
}

#[test]
fn awkward_limits_give_fitting_steps() {
    let mut limit = 1.3e-7;
    while limit < 1.0 {
        for every in [None, Some(1e-3), Some(0.011), Some(1.0 / 3.0)] {
            let plan = ours(limit, 0.7, every).unwrap();
            assert!(plan.step <= limit * (1.0 + 1e-15), "{limit} {every:?}");
            let again = given(plan.step, 0.7, every).unwrap();
            assert_eq!(again, plan);
            let end = plan.time(plan.steps);
            assert!((end - 0.7).abs() <= 0.7e-9, "{end}");
        }
        limit *= 1.618;
    }
}

#[test]
fn incommensurate_intervals_name_intervals_that_fit() {
    let every = 1.2347e-3;
    let Err(PlanError::Incommensurate { intervals, .. }) = ours(1e-4, 0.5, Some(every)) else {
        panic!();
    };
    assert_eq!(intervals.len(), 2);
    for every in intervals {
        assert!(ours(1e-4, 0.5, Some(every)).is_ok());
    }
}

#[test]
fn about_five_hundred_samples() {
    let strides = [
        (25_000, 50),
        (500, 1),
        (1, 1),
        (249, 1),
        (750, 2),
        (1_000, 2),
        (1_667, 4),
        (100_003, 201),
        (1 << 20, 1 << 11),
    ];
    for (steps, stride) in strides {
        assert_eq!(stride_for(steps), stride, "{steps}");
    }
    let plan = given(1.0, 100_003.0, None).unwrap();
    assert_eq!(plan.samples(), 499);
}

/// Every request is planned or rejected, and the proposals of a rejection are valid.
#[test]
fn extreme_times_are_planned_or_refused_with_times_that_fit() {
    let times = [
        5e-324,
        1e-310,
        1e-300,
        1e-150,
        1e-20,
        3e-9,
        1e-7,
        1e-3,
        0.5,
        0.7,
        1e6,
        1e12,
        1e19,
        2e19,
        1e150,
        1e300,
        f64::MAX,
    ];
    for duration in times {
        for limit in times.into_iter().chain([0.0, f64::INFINITY]) {
            for every in times.map(Some).into_iter().chain([None]) {
                let request = |step| Request { step, duration, every };
                for step in [StepRequest::Given(limit), StepRequest::AtMost(limit)] {
                    let asked = request(step);
                    check(&asked, plan(&asked));
                }
            }
        }
    }
    fn check(asked: &Request, planned: Result<Plan, PlanError>) {
        let again = |step: Option<f64>, every: Option<f64>| {
            let step = step.map_or(asked.step, StepRequest::Given);
            let every = every.or(asked.every);
            plan(&Request { step, every, ..*asked })
        };
        match planned {
            Ok(plan) => {
                assert!(plan.steps >= 1 && plan.stride >= 1 && plan.step > 0.0, "{asked:?}");
                assert!(plan.samples() <= MAX_SAMPLES, "{asked:?}");
            }
            // A second error may follow the first, but not the same one again.
            Err(PlanError::Multiple { steps, intervals, .. }) => {
                let steps = steps.into_iter().map(|step| again(Some(step), None));
                let intervals = intervals.into_iter().map(|every| again(None, Some(every)));
                for next in steps.chain(intervals) {
                    assert!(!matches!(next, Err(PlanError::Multiple { .. })), "{asked:?}");
                }
            }
            Err(PlanError::Incommensurate { intervals, .. }) => {
                for every in intervals {
                    let next = again(None, Some(every));
                    let same = matches!(next, Err(PlanError::Incommensurate { .. }));
                    assert!(!same, "{asked:?} {every:e}");
                }
            }
            Err(PlanError::Samples { every, .. }) => {
                let next = again(None, Some(every));
                assert!(!matches!(next, Err(PlanError::Samples { .. })), "{asked:?} {every:e}");
            }
            Err(PlanError::Steps { .. } | PlanError::Every { .. }) => {}
        }
    }
}

#[test]
fn a_tiny_sampling_interval_is_refused_for_its_samples() {
    for every in [1e-13, 1e-20, 1e-150, 5e-324] {
        for step in [StepRequest::AtMost(1e-5), StepRequest::Given(1e-5)] {
            let refused = plan(&Request { step, duration: 1.0, every: Some(every) });
            let Err(PlanError::Samples { samples, every }) = refused else {
                panic!("{every:e}: {refused:?}");
            };
            assert!(samples > 1e8 && (1e-4..1e-2).contains(&every), "{samples:e} {every}");
        }
    }
}

#[test]
fn absurd_requests_are_refused_with_advice() {
    assert!(matches!(given(1e-300, 0.5, None), Err(PlanError::Steps { .. })));
    assert!(matches!(ours(1e-300, 0.5, None), Err(PlanError::Steps { .. })));
    assert!(matches!(ours(0.0, 0.5, None), Err(PlanError::Steps { .. })));
    let Err(PlanError::Samples { samples, every }) = given(1e-9, 0.5, Some(1e-9)) else {
        panic!();
    };
    assert_eq!(samples, 500_000_001.0);
    assert!(given(1e-9, 0.5, Some(every)).is_ok());
}
