//! All targets by name.

use crate::command_line::CommandLineTarget;
use crate::line::LineTarget;
use crate::planted::PlantedTarget;
use crate::scene::SceneTarget;
use crate::snapshot::SnapshotTarget;
use crate::stepper::StepTarget;
use crate::target::Target;

/// The targets of a campaign.
pub const ALL: [&dyn Target; 5] =
    [&SceneTarget, &SnapshotTarget, &StepTarget, &LineTarget, &CommandLineTarget];

/// The target of a name; the planted faults are one, too.
#[must_use]
pub fn of_name(name: &str) -> Option<&'static dyn Target> {
    let planted: &dyn Target = &PlantedTarget;
    ALL.into_iter().chain([planted]).find(|target| target.name() == name)
}

/// The target that a file of an input names: `TARGET-…`.
#[must_use]
pub fn of_file(name: &str) -> Option<&'static dyn Target> {
    let (target, _) = name.rsplit_once('-')?;
    of_name(target)
}
