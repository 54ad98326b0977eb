"""The environment against gymnasium's own checks, and many against one."""

from __future__ import annotations

import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

import dbd
import dbd.gym

GAINS = np.array([-20.0, 88.97, -18.33, 17.54])


def force(seen: np.ndarray) -> np.ndarray:
    """The action of the balance example: its force over 20 N."""
    return np.clip(-seen @ GAINS / dbd.gym.FORCE, -1.0, 1.0)[..., None].astype(np.float32)


def test_gymnasium_has_nothing_against_it() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # Where the tests run there may be no screen.
        warnings.filterwarnings("ignore", message=".*cannot open a window")
        check_env(gymnasium.make("dbd/CartPendulum-v0").unwrapped)


def test_seeds_repeat_and_a_controller_balances() -> None:
    one, other = (gymnasium.make("dbd/CartPendulum-v0") for _ in range(2))
    seen, _ = one.reset(seed=7)
    assert np.array_equal(seen, other.reset(seed=7)[0])
    assert not np.array_equal(seen, other.reset(seed=8)[0])
    assert np.all(np.abs(seen) <= 0.06)
    rewards, truncated = 0.0, False
    while not truncated:
        seen, reward, terminated, truncated, _ = one.step(force(seen))
        assert not terminated
        rewards += reward
    assert rewards == 500.0 and np.all(np.abs(seen) < 0.01)


def test_it_ends_where_the_pendulum_leans_too_far() -> None:
    environment = gymnasium.make("dbd/CartPendulum-v0")
    seen, _ = environment.reset(seed=1)
    terminated, actions = False, 0
    while not terminated:
        seen, _, terminated, _, _ = environment.step(np.zeros(1, dtype=np.float32))
        actions += 1
        assert environment.observation_space.contains(seen)
    assert actions < 100 and abs(seen[1]) > dbd.gym.STEEPEST


def test_many_are_so_many_of_one() -> None:
    count = 5
    many = gymnasium.make_vec("dbd/CartPendulum-v0", num_envs=count)
    assert many.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    like = gymnasium.vector.SyncVectorEnv(
        [lambda: gymnasium.make("dbd/CartPendulum-v0")] * count,
        autoreset_mode=AutoresetMode.NEXT_STEP,
    )
    assert (many.observation_space, many.action_space) == (like.observation_space, like.action_space)
    assert np.array_equal(many.reset(seed=3)[0], like.reset(seed=3)[0])
    random = np.random.default_rng(5)
    ended = 0
    for _ in range(300):
        actions = random.uniform(-1.0, 1.0, (count, 1)).astype(np.float32)
        ours, theirs = many.step(actions)[:4], like.step(actions)[:4]
        for our, their in zip(ours, theirs, strict=True):
            assert np.array_equal(our, their)
        ended += int(ours[2].sum())
    assert ended > 2 * count
    many.close()


def test_an_episode_of_many_is_cut_off() -> None:
    many = gymnasium.make_vec("dbd/CartPendulum-v0", num_envs=2, max_episode_steps=3)
    seen, _ = many.reset(seed=[4, None])
    for expected in (False, False, True, False):
        seen, rewards, _, truncated, _ = many.step(force(seen))
        assert truncated.tolist() == [expected] * 2
    # The reset's step brings nothing.
    assert rewards.tolist() == [0.0, 0.0]
    for seed in ([1], [1, 2, 3]):
        with pytest.raises(ValueError, match="one per environment"):
            many.reset(seed=seed)
    with pytest.raises(ValueError, match="at least 1"):
        dbd.gym.CartPendulumVector(0)


def test_pictures_show_the_state() -> None:
    one = gymnasium.make("dbd/CartPendulum-v0", render_mode="rgb_array")
    many = gymnasium.make_vec("dbd/CartPendulum-v0", num_envs=2, render_mode="rgb_array")
    one.reset(seed=3)
    many.reset(seed=3)
    first = one.render()
    assert first.shape == (400, 600, 3) and first.dtype == np.uint8
    both = many.render()
    assert np.array_equal(both[0], first) and not np.array_equal(both[1], first)
    # Pushed to the right, the cart's blue goes to the right.
    place = [np.argwhere(first[..., 2] > first[..., 0].astype(int) + 80)[:, 1].mean()]
    for _ in range(5):
        one.step(np.ones(1, dtype=np.float32))
        shown = one.render()
        place.append(np.argwhere(shown[..., 2] > shown[..., 0].astype(int) + 80)[:, 1].mean())
    assert all(before < after for before, after in zip(place, place[1:], strict=False))
    one.close()
    for mode in ("ansi", "human"):
        with pytest.raises(ValueError, match="known modes: 'rgb_array'"):
            dbd.gym.CartPendulumVector(1, render_mode=mode)
    with pytest.raises(ValueError, match="'human', 'rgb_array'"):
        dbd.gym.CartPendulum("ansi")
    with pytest.warns(UserWarning, match="needs a render_mode"):
        assert dbd.gym.CartPendulum().render() is None


def test_an_action_that_is_no_number_is_refused() -> None:
    environment = dbd.gym.CartPendulum()
    environment.reset(seed=1)
    with pytest.raises(dbd.InputError):
        environment.step(np.array([np.nan], dtype=np.float32))
