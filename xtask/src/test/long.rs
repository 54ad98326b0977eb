//! Tests that `cargo xtask test --quick` leaves out.

use super::cases::Case;

/// \[s\] a test that takes longer, on a quiet machine, belongs into the list.
const LIMIT: f64 = 3.0;

/// Program and test, each longer than [`LIMIT`].
pub const LONG: [(&str, &str); 22] = [
    ("mechanics::mechanics", "orientation::every_scheme_keeps_its_order"),
    ("mechanics::mechanics", "planar::a_planar_model_moves_as_the_spatial_one_in_every_scheme"),
    ("tests::command_line", "tutorial::the_tutorial_does_what_it_says"),
    ("tests::dynamics", "frequency::the_bound_holds_along_the_run_of_every_scene::test"),
    ("tests::dynamics", "frequency::written_in_the_page"),
    ("tests::dynamics", "reference_implicit::large_steps_are_calm"),
    ("tests::dynamics", "reference_truth::the_two_opinions_agree_on_every_scene"),
    ("tests::dynamics", "reference_truth::the_window_ends_where_a_perturbation_has_grown"),
    (
        "tests::dynamics",
        "reference_truth::the_papers_mechanisms_are_worth_comparing_for_half_a_second",
    ),
    ("tests::dynamics", "scenes::every_scene_runs_and_keeps_its_energy"),
    ("tests::dynamics", "stability::four_bar"),
    ("tests::dynamics", "stability::five_bar_b"),
    ("tests::dynamics", "stability::six_bar"),
    ("tests::dynamics", "stability::three_rrr"),
    ("tests::dynamics", "stability::crank_slider"),
    ("tests::dynamics", "stability::sweeps_keep_the_step_that_explicit_damping_loses"),
    ("tests::dynamics", "stability::written_in_the_page"),
    (
        "tests::trade",
        "two_surveys_give_the_same_accuracy_to_the_last_bit_however_they_are_interrupted",
    ),
    ("tests::trade", "every_step_of_a_survey_is_one_that_a_run_accepts"),
    ("tests::trade", "a_planar_scenes_points_have_the_stable_step_in_space_beside_them"),
    ("tests::trade", "models::the_page_says_what_other_models_of_a_mechanism_come_to"),
    ("tests::trade", "a_survey_holds_every_way_and_says_what_is_unstable"),
];

/// The long tests of a program.
pub fn of(program: &str) -> impl Iterator<Item = &'static str> {
    LONG.into_iter().filter(move |(of, _)| *of == program).map(|(_, test)| test)
}

/// Tests of the list that are not among all that there are.
pub fn missing(cases: &[Case]) -> Vec<String> {
    let names = LONG.into_iter().map(|(program, test)| format!("{program} {test}"));
    names.filter(|name| !cases.iter().any(|case| case.name == *name)).collect()
}

/// Tests that took longer than the limit and are not in the list.
pub fn unlisted(cases: &[Case]) -> Vec<&Case> {
    let listed = |case: &Case| {
        LONG.into_iter().any(|(program, test)| case.name == format!("{program} {test}"))
    };
    cases.iter().filter(|case| case.seconds > LIMIT && !listed(case)).collect()
}
