//! Valid and invalid names and parameters of methods.

use miette::Diagnostic as _;

use super::*;

#[test]
fn the_names_are_those_of_the_kernel() {
    for scheme in SchemeName::ALL {
        let method = Method::new(*scheme, None, PrecisionName::F64).unwrap();
        assert_eq!(method.scheme_name(), scheme.name());
        assert_eq!(SchemeName::of_name(scheme.name()), Some(*scheme));
    }
    assert_eq!(SchemeName::of_name("euler"), None);
    assert_eq!(
        Method::default(),
        Method::new(SchemeName::default(), None, PrecisionName::F64).unwrap()
    );
    assert_eq!(
        DampingName::Explicit.summary(),
        "Damper forces at the velocities of each evaluation: limits the step"
    );
}

#[test]
fn what_is_for_comparison_is_refused_with_its_remedy_where_it_is_not_built() {
    let built = cfg!(feature = "comparison");
    for precision in PrecisionName::ALL {
        for orientation in OrientationName::ALL {
            let method = Method::new(SchemeName::Rk4, None, *precision).unwrap();
            let method = method.with_orientation(*orientation);
            let quaternions = *orientation == OrientationName::Quaternion;
            let aside = *precision == PrecisionName::F32Micromath;
            let exists = quaternions || precision.has_angles();
            let held = if built { exists } else { quaternions && !aside };
            assert_eq!(method.check_built().is_ok(), held, "{method:?}");
            let refused = matches!(method.check_built(), Err(MethodError::Orientation { .. }));
            assert_eq!(refused, !exists, "{method:?}");
        }
    }
    let help = MethodError::Comparison { what: "euler-321" }.help().unwrap().to_string();
    assert!(help.contains("--features comparison"), "{help}");
}

#[test]
fn newton_iterations_belong_to_the_dbd_schemes() {
    for (scheme, evaluations) in
        [(SchemeName::Dbd, 5), (SchemeName::DbdP1, 4), (SchemeName::DbdP2, 5)]
    {
        let method = Method::new(scheme, Some(2), PrecisionName::F64).unwrap();
        assert_eq!((method.newton(), method.evaluations()), (Some(2), evaluations));
        assert!(Method::new(scheme, Some(8), PrecisionName::F64).is_ok());
        let refused = Method::new(scheme, Some(9), PrecisionName::F64);
        assert_eq!(refused, Err(MethodError::Iterations { newton: 9 }));
    }
    for scheme in SchemeName::ALL {
        let method = Method::new(*scheme, None, PrecisionName::F64).unwrap();
        if method.newton().is_none() {
            let refused = Method::new(*scheme, Some(0), PrecisionName::F64);
            assert_eq!(refused, Err(MethodError::Newton { scheme: method.scheme_name() }));
        }
    }
}

#[test]
fn a_scheme_has_its_own_damping_and_two_have_all_but_implicit() {
    let several = ["semi-implicit-euler", "leapfrog"];
    for scheme in SchemeName::ALL {
        let own = Method::new(*scheme, None, PrecisionName::F64).unwrap();
        for damping in DampingName::ALL {
            let name = damping.name();
            match own.with_damping(*damping) {
                Ok(method) => {
                    assert_eq!(method.damping().name(), name);
                    assert_eq!(method.scheme_name(), own.scheme_name());
                    assert!(method == own || several.contains(&own.scheme_name()));
                }
                Err(refused) => {
                    let implicit = *damping == DampingName::Implicit;
                    assert!(implicit || !several.contains(&own.scheme_name()));
                    let text = refused.to_string();
                    assert!(text.contains(name) && text.contains(own.damping().name()));
                }
            }
        }
    }
}
