//! A mechanism in motion: the large view at several poses, shown one after the other.
//!
//! `(mechanism, poses, duration) => SVG` that repeats without scripts, so that a page may show it as an image.

use std::fmt::Write as _;

use dbd_kernel::Vec3;

use crate::output::markup::escape;
use crate::picture::bodies::colours;
use crate::picture::drawing::{Drawing, crowded};
use crate::picture::mechanism::Mechanism;
use crate::picture::sheet::{MARGIN, ROUND_SMALL, WIDTH, fitting, scale, symbols};
use crate::picture::style::{ROOT, sheet};
use crate::picture::view::{Frame, Views, extent, reach};

/// \[pixels\] largest height of the drawn part.
const HEIGHT: f64 = 320.0;

/// Position \[m\] and unit quaternion (scalar first, body → world) of each body.
pub type Pose = Vec<([f64; 3], [f64; 4])>;

/// The mechanism at each pose for an equal part of `seconds` \[s\], repeated. A pose may have fewer bodies than the
/// mechanism; the others keep their place.
#[must_use]
pub fn motion(mechanism: &Mechanism, poses: &[Pose], seconds: f64) -> String {
    let moved: Vec<Mechanism> = poses.iter().map(|pose| at(mechanism, pose)).collect();
    let reach: Vec<Vec3<f64>> = moved.iter().flat_map(reach).collect();
    let view = Views::of(mechanism).main;
    let ((across, up), middle) = extent(&view, &reach);
    let room = (WIDTH - 2.0 * (MARGIN + ROUND_SMALL.0), HEIGHT);
    let scale = scale(fitting(across, up, room));
    let height = (up * scale).clamp(0.0, HEIGHT) + 2.0 * ROUND_SMALL.1;
    let centre = (0.5 * WIDTH, 0.5 * height);
    let mut frame = Frame { view, middle, centre, scale, symbols: 1.0 };
    frame.symbols = symbols(mechanism, &frame, 1.0);
    let colours = colours(mechanism);
    let count = poses.len().max(1) as f64;
    let mut text = String::new();
    for (n, mechanism) in moved.iter().enumerate() {
        // With a negative delay an animation has begun that long ago.
        let delay = (n as f64 / count - 1.0) * seconds;
        let _ = writeln!(text, "<g class=\"pose\" style=\"animation-delay:{delay:.3}s\">");
        let drawing = Drawing { mechanism, frame: &frame, colours: &colours };
        if crowded(mechanism) {
            drawing.lines(&mut text);
        } else {
            drawing.symbols(&mut text, None);
        }
        text.push_str("</g>\n");
    }
    let name = escape(&dbd_scene::shortened(&mechanism.name).replace(char::is_control, " "));
    let height = height.ceil();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{ROOT}\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\" role=\"img\">\n<title>The mechanism {name} in motion</title>\n<style>\n{}\
         .{ROOT} .pose {{ visibility: hidden; animation: pose {seconds:.3}s step-end infinite; }}\n\
         @keyframes pose {{ 0% {{ visibility: visible; }} {:.4}% {{ visibility: hidden; }} }}\n</style>\n\
         <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>\n{text}</svg>\n",
        sheet(),
        100.0 / count,
    )
}

/// The mechanism at a pose.
fn at(mechanism: &Mechanism, pose: &Pose) -> Mechanism {
    let mut moved = mechanism.clone();
    for (body, (position, orientation)) in moved.bodies.iter_mut().zip(pose) {
        (body.position, body.orientation) = (*position, *orientation);
    }
    moved
}
