//! The controllers among the examples do what they say.

#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../host-sim/examples/balance.rs"]
mod balance;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../host-sim/examples/follow.rs"]
mod follow;

#[test]
fn the_pendulum_stays_up_for_a_minute() {
    let seconds = balance::balance(60_000).unwrap();
    assert_eq!(seconds.len(), 60);
    // Released five degrees off; upright and still after a few seconds, to the end.
    assert!(seconds[0][1] > 0.08, "{:?}", seconds[0]);
    for [cart, angle] in &seconds[5..] {
        assert!(*cart < 1e-3 && *angle < 1e-3, "{cart} {angle}");
    }
}

#[test]
fn the_delta_keeps_to_its_path() {
    let furthest = follow::follow(12_000).unwrap();
    // 1.12 mm: of it the joints' compliance is what no joint controller sees.
    assert!(furthest > 1e-5 && furthest < 1.5e-3, "{furthest}");
}
