//! Section 2.4: the spectrum of spring extensions after a change of free lengths.

use std::f64::consts::TAU;

use dbd_kernel::State;
use dbd_kernel::energy::each_extension;
use dbd_plant::digits::significant;
use dbd_plant::{SchemeName, plant_of_model};
use dbd_scene::Scene;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use serde::Serialize;

use crate::modes::{MAX_BODIES, extremes, modes};
use crate::paper::context::{Context, PaperError, advance, scheme};
use crate::paper::finding::{Curve, Finding, Map, Plot, Row, Tolerance, assumptions};
use crate::paper::plot::svg;
use crate::stability::frozen;

/// \[Hz\] section 2.4.
const DOMINANT: f64 = 752.0;

/// \[m\] by which free lengths change.
const CHANGE: f64 = 1e-3;

/// Samples of a signal: a power of two.
const SAMPLES: usize = 1 << 13;

/// How a run is sampled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sampling {
    /// \[s\] between samples; resolution and highest frequency of the spectrum follow.
    interval: f64,
    /// \[Hz\] the highest frequency that is looked at.
    shown: f64,
}

impl Sampling {
    /// Of the figure of the paper.
    pub(super) const PAPER: Self = Self { interval: 5e-5, shown: 2000.0 };

    /// Of a scene whose highest frequency \[Hz\] is this one.
    fn up_to(highest: f64) -> Self {
        Self { interval: 1.0 / (8.0 * highest), shown: 2.0 * highest }
    }

    /// \[Hz\] between two frequencies of the spectrum.
    fn resolution(self) -> f64 {
        1.0 / (SAMPLES as f64 * self.interval)
    }
}

/// The magnitude spectrum of a signal.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    /// \[m\] extensions of one spring of each joint, in order of the joints.
    signals: Vec<Vec<f64>>,
    /// \[Hz\], and the root of the signals' summed power, the largest 1.
    pub points: Vec<[f64; 2]>,
}

impl Spectrum {
    /// \[Hz\] of the largest magnitude.
    pub(super) fn dominant(&self) -> f64 {
        let largest = self.points.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
        largest.map_or(0.0, |[frequency, _]| *frequency)
    }

    /// The signal with the largest power at the dominant frequency.
    fn loudest(&self) -> &[f64] {
        let power = |signal: &&Vec<f64>| signal.iter().map(|x| x * x).sum::<f64>();
        let found = self.signals.iter().max_by(|a, b| power(a).total_cmp(&power(b)));
        found.map_or(&[], Vec::as_slice)
    }
}

/// The spectrum of a scene's pose at t = 0, frozen, after the free lengths of all springs of its joint
/// `joint` have changed.
pub(super) fn of(scene: &Scene, joint: usize, sampling: Sampling) -> Result<Spectrum, PaperError> {
    let mut model = frozen(&scene.model, &State::initial(&scene.model));
    // Every other element: equal changes of all of a joint's springs would cancel by symmetry.
    let groups = scene.joints[joint].groups.clone();
    for row in groups {
        let group = model.groups[row];
        let first = usize::from(group.element);
        for element in (first..first + group.elements()).step_by(2) {
            if let Some(spring) = model.tsdas.get_mut(element) {
                spring.free_length += CHANGE;
            }
        }
    }
    let mut plant =
        plant_of_model(&model, &scheme(SchemeName::Leapfrog)?, sampling.interval / 4.0)?;
    let firsts: Vec<usize> = scene.joints.iter().map(|joint| joint.groups.start).collect();
    let mut signals = vec![Vec::with_capacity(SAMPLES); firsts.len()];
    for _ in 0..SAMPLES {
        let state = plant.state();
        let mut last = None;
        each_extension(plant.model(), &state, |group, extension| {
            if last != Some(group) {
                for (signal, first) in signals.iter_mut().zip(&firsts) {
                    if *first == group {
                        signal.push(extension);
                    }
                }
            }
            last = Some(group);
        });
        advance(plant.as_mut(), 4)?;
    }
    let points = summed(&signals, sampling);
    Ok(Spectrum { signals, points })
}

/// Result of the paper's procedure for a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Kick {
    /// The joint whose springs were lengthened.
    pub joint: String,
    /// \[Hz\] the frequency of the largest magnitude.
    pub dominant: f64,
    /// \[Hz\] between two frequencies of the spectrum.
    pub resolution: f64,
    /// \[N/m\] of a spring of the joint.
    pub stiffness: f64,
    /// \[N·s/m\] the damping constant that follows, `2·k/ω`.
    pub damping: f64,
    /// \[Hz\] the nearest eigenfrequency of the frozen pose.
    pub nearest: f64,
    /// Ratio of the dominant to the nearest eigenfrequency.
    pub ratio: f64,
    /// Magnitude spectrum and wavelet scalogram: title and SVG.
    #[serde(skip)]
    pub plots: [(String, String); 2],
}

impl Kick {
    /// Text for people.
    #[must_use]
    pub fn sentence(&self) -> String {
        format!(
            "springs of joint `{}` lengthened by 1 mm: dominant frequency {} ± {} Hz, {} times the nearest \
             eigenfrequency, {} Hz; c = 2k/ω = {} N·s/m with k = {} N/m",
            self.joint,
            significant(self.dominant, 5),
            significant(0.5 * self.resolution, 2),
            significant(self.ratio, 5),
            significant(self.nearest, 5),
            significant(self.damping, 4),
            significant(self.stiffness, 4),
        )
    }
}

/// Section 2.4 on any scene: lengthens every other spring of a joint about the frozen pose at t = 0, runs, and takes
/// the dominant frequency of all joints' extensions.
///
/// # Errors
/// If there are no modes, nothing vibrates, or the run fails.
pub fn kick(scene: &Scene, joint: usize) -> Result<Kick, PaperError> {
    let model = frozen(&scene.model, &State::initial(&scene.model));
    let state = State::initial(&model);
    let frequencies = if model.bodies.len() > MAX_BODIES {
        extremes(&model, &state, [200, 20])?.frequencies
    } else {
        modes(&model, &state)?.frequencies
    };
    let highest = frequencies.last().copied().unwrap_or(0.0);
    if highest <= 0.0 {
        return Err(PaperError::Still);
    }
    let sampling = Sampling::up_to(highest);
    let spectrum = of(scene, joint, sampling)?;
    let dominant = spectrum.dominant();
    let nearest = |a: &f64, b: &f64| (a - dominant).abs().total_cmp(&(b - dominant).abs());
    let nearest = frequencies.into_iter().min_by(nearest).unwrap_or(0.0);
    let elements = dbd_scene::joint_elements(scene);
    let stiffness = elements.iter().find(|element| element.joint == joint);
    let stiffness = stiffness.map_or(0.0, |element| element.stiffness);
    Ok(Kick {
        joint: scene.joints[joint].name.clone(),
        dominant,
        resolution: sampling.resolution(),
        stiffness,
        damping: 2.0 * stiffness / (TAU * dominant),
        nearest,
        ratio: dominant / nearest,
        plots: plots(&spectrum, sampling).map(|plot| (plot.title.clone(), svg(&plot))),
    })
}

/// A Hann window, mean taken off.
fn windowed(signal: &[f64]) -> Vec<Complex<f64>> {
    let count = signal.len() as f64;
    let mean = signal.iter().sum::<f64>() / count;
    let weight = |n: usize| 0.5 - 0.5 * (TAU * n as f64 / count).cos();
    signal.iter().enumerate().map(|(n, x)| Complex::new((x - mean) * weight(n), 0.0)).collect()
}

/// Frequencies up to the highest shown one, and the root of the signals' summed power over its largest.
fn summed(signals: &[Vec<f64>], sampling: Sampling) -> Vec<[f64; 2]> {
    let fft = FftPlanner::new().plan_fft_forward(SAMPLES);
    let mut power = vec![0.0; SAMPLES / 2];
    for signal in signals.iter().filter(|signal| signal.len() == SAMPLES) {
        let mut spectrum = windowed(signal);
        fft.process(&mut spectrum);
        power.iter_mut().zip(&spectrum).for_each(|(sum, value)| *sum += value.norm_sqr());
    }
    let largest = power.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let frequency = |bin: usize| bin as f64 * sampling.resolution();
    let points =
        power.iter().enumerate().map(|(bin, power)| [frequency(bin), (power / largest).sqrt()]);
    points.filter(|[frequency, _]| *frequency > 0.0 && *frequency <= sampling.shown).collect()
}

/// Morlet wavelet magnitudes: time \[ms\] by frequency \[kHz\].
fn scalogram(signal: &[f64], sampling: Sampling) -> Option<Map> {
    /// Oscillations of the wavelet within its width.
    const CENTRE: f64 = 6.0;
    const COLUMNS: usize = 120;
    const ROWS: usize = 60;
    let Sampling { interval, shown } = sampling;
    let mut planner = FftPlanner::new();
    let (forward, back) = (planner.plan_fft_forward(SAMPLES), planner.plan_fft_inverse(SAMPLES));
    if signal.len() != SAMPLES {
        return None;
    }
    let mut spectrum = windowed(signal);
    forward.process(&mut spectrum);
    let frequencies: Vec<f64> = (1..=ROWS).map(|n| shown * n as f64 / ROWS as f64).collect();
    let mut values = Vec::with_capacity(ROWS);
    for frequency in &frequencies {
        let scale = CENTRE / (TAU * frequency);
        let mut row: Vec<Complex<f64>> = spectrum
            .iter()
            .enumerate()
            .map(|(bin, value)| {
                let omega = TAU * bin as f64 / (SAMPLES as f64 * interval);
                let weight = if bin < SAMPLES / 2 {
                    (-0.5 * (scale * omega - CENTRE).powi(2)).exp()
                } else {
                    0.0
                };
                value * weight
            })
            .collect();
        back.process(&mut row);
        let step = SAMPLES / COLUMNS;
        values.push((0..COLUMNS).map(|n| row[n * step + step / 2].norm()).collect::<Vec<f64>>());
    }
    let largest = values.iter().flatten().copied().fold(f64::MIN_POSITIVE, f64::max);
    values.iter_mut().flatten().for_each(|value| *value /= largest);
    let time = |n: usize| 1e3 * interval * (SAMPLES / COLUMNS) as f64 * (n as f64 + 0.5);
    Some(Map {
        x: (0..COLUMNS).map(time).collect(),
        y: frequencies.iter().map(|frequency| 1e-3 * frequency).collect(),
        values,
    })
}

/// Spectrum and scalogram, as in Fig. 4.
fn plots(spectrum: &Spectrum, sampling: Sampling) -> [Plot; 2] {
    let curve = Curve {
        name: "spring extensions of all joints".into(),
        paper: false,
        line: true,
        points: spectrum.points.iter().map(|[f, m]| [1e-3 * f, *m]).collect(),
    };
    [
        Plot {
            name: "a".into(),
            title: "Magnitude spectrum".into(),
            axes: ["frequency [kHz]".into(), "magnitude over its largest".into()],
            logarithmic: [false, false],
            curves: vec![curve],
            map: None,
        },
        Plot {
            name: "b".into(),
            title: "Wavelet scalogram".into(),
            axes: ["time [ms]".into(), "frequency [kHz]".into()],
            logarithmic: [false, false],
            curves: Vec::new(),
            map: scalogram(spectrum.loudest(), sampling),
        },
    ]
}

/// Fig. 4.
pub(super) fn spectrum(context: &Context<'_>) -> Result<Finding, PaperError> {
    let scene = context.scene("3ruu")?;
    let mut found = Vec::new();
    for joint in 0..scene.joints.len() {
        found.push((joint, of(&scene, joint, Sampling::PAPER)?));
    }
    let nearest = |a: &f64, b: &f64| (a - DOMINANT).abs().total_cmp(&(b - DOMINANT).abs());
    let dominants: Vec<f64> = found.iter().map(|(_, spectrum)| spectrum.dominant()).collect();
    let ours = dominants.iter().copied().min_by(nearest).unwrap_or(0.0);
    let (joint, spectrum) = &found[dominants.iter().position(|f| *f == ours).unwrap_or(0)];
    let frequencies = modes(&scene.model, &State::initial(&scene.model))?.frequencies;
    let mode = frequencies.iter().copied().min_by(nearest).unwrap_or(0.0);
    let highest = frequencies.last().copied().unwrap_or(0.0);
    let least = dominants.iter().copied().fold(f64::INFINITY, f64::min);
    let most = dominants.iter().copied().fold(0.0, f64::max);
    let tolerance = Tolerance { within: 0.05, factor: 2.0 };
    let rows = vec![
        Row::compared("dominant frequency", "Hz", DOMINANT, ours, tolerance).noted(format!(
            "springs of joint {} changed, the one of {} that comes nearest; others give {least:.0} to {most:.0} Hz",
            scene.joints[*joint].name,
            scene.joints.len()
        )),
        Row::compared("nearest mode of the pose", "Hz", DOMINANT, mode, tolerance),
        Row::open(
            "which springs were changed",
            "",
            None,
            None,
            "the text says selected springs; the dominant frequency depends on the choice",
        ),
        Row::extra("highest mode of the pose, which limits the step", "Hz", highest),
    ];
    let mut plots = plots(spectrum, Sampling::PAPER);
    plots[0].curves.insert(
        0,
        Curve {
            name: "paper: 752 Hz".into(),
            paper: true,
            line: true,
            points: vec![[1e-3 * DOMINANT, 0.0], [1e-3 * DOMINANT, 1.0]],
        },
    );
    Ok(Finding {
        assumptions: assumptions(&[
            "About the pose at t = 0 without gravity and preloads, 1 MN/m, undamped; every other spring of one joint is lengthened by 1 mm.",
            "Hann window, 0.41 s in samples of 50 µs; Morlet wavelet with six oscillations.",
        ]),
        rows,
        plots: plots.into(),
        ..Finding::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_is_found_where_it_is_in_both_pictures() {
        let tone = |n: usize| (TAU * 700.0 * Sampling::PAPER.interval * n as f64).sin();
        let signal: Vec<f64> = (0..SAMPLES).map(tone).collect();
        let points = summed(std::slice::from_ref(&signal), Sampling::PAPER);
        let spectrum = Spectrum { signals: Vec::new(), points };
        assert!((spectrum.dominant() - 700.0).abs() < 2.5, "{}", spectrum.dominant());
        let map = scalogram(&signal, Sampling::PAPER).unwrap();
        let middle = map.x.len() / 2;
        let row = (0..map.y.len())
            .max_by(|a, b| map.values[*a][middle].total_cmp(&map.values[*b][middle]));
        assert!((map.y[row.unwrap()] - 0.7).abs() < 0.04);
        assert!(scalogram(&signal[1..], Sampling::PAPER).is_none());
    }
}
