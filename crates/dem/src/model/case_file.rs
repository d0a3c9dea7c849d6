//! A case as its file gives it: missing values have defaults that depend on the other values.

use super::{
    Case, CaseError, ContactConvention, InvalidValue, Preparation, Protocol, Sampling, Shortcuts,
    SideWalls, WrittenStack,
};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;

/// A case of which only a part is written.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartialCase {
    /// The stack.
    pub stack: WrittenStack,
    /// Contact convention. Without this table it is that of the code; a key that the table leaves out has the paper's
    /// value.
    pub convention: Option<ContactConvention>,
    /// Preparation, compression and sampling; what is left out is planned for the stack.
    #[serde(default)]
    pub protocol: PartialProtocol,
}

/// A protocol of which only a part is written.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PartialProtocol {
    /// The way in which the stack is brought to rest.
    pub preparation: Option<Preparation<Option<f64>>>,
    /// Time step of the integrator, in √(m/k_n).
    pub time_step: Option<f64>,
    /// Speed of the top wall, downwards, in r √(k_n/m).
    pub wall_speed: Option<f64>,
    /// Total distance that the wall moves, in r.
    pub wall_travel: Option<f64>,
    /// Times at which rows are taken.
    pub sampling: Sampling<Option<f64>>,
    /// Options that make the run shorter; native alone has them.
    pub shortcuts: Option<Shortcuts>,
}

impl PartialProtocol {
    /// Returns the side walls as given, with the paper's values for stacks of stiffness 1/ε where values are missing.
    pub fn side_walls(&self, epsilon: f64) -> Option<SideWalls> {
        let Some(Preparation::SideWalls(written)) = self.preparation else {
            return None;
        };
        let paper = SideWalls::paper(written.push.unwrap_or(0.0), epsilon);
        Some(SideWalls {
            push: paper.push,
            fall_speed: written.fall_speed.unwrap_or(paper.fall_speed),
            landing_speed: written.landing_speed.unwrap_or(paper.landing_speed),
            withdrawal_speed: written.withdrawal_speed.unwrap_or(paper.withdrawal_speed),
            withdrawal: written.withdrawal.unwrap_or(paper.withdrawal),
            settle_time: written.settle_time.unwrap_or(paper.settle_time),
            rest_time: written.rest_time.unwrap_or(paper.rest_time),
        })
    }

    /// Returns `planned` with the values given here in place of its own, except those of side walls.
    #[must_use]
    pub fn over(&self, planned: &Protocol) -> Protocol {
        let (sampling, own) = (&self.sampling, planned.sampling);
        Protocol {
            preparation: self.preparation_over(planned.preparation),
            time_step: self.time_step.unwrap_or(planned.time_step),
            wall_speed: self.wall_speed.unwrap_or(planned.wall_speed),
            wall_travel: self.wall_travel.unwrap_or(planned.wall_travel),
            sampling: Sampling {
                coarse_interval: sampling.coarse_interval.unwrap_or(own.coarse_interval),
                fine_from_travel: sampling.fine_from_travel.unwrap_or(own.fine_from_travel),
                fine_interval: sampling.fine_interval.unwrap_or(own.fine_interval),
            },
            shortcuts: self.shortcuts.or(planned.shortcuts),
        }
    }

    fn preparation_over(&self, planned: Preparation) -> Preparation {
        match (self.preparation, planned) {
            (
                Some(Preparation::GravityRamp {
                    ramp_time,
                    rest_time,
                }),
                Preparation::GravityRamp {
                    ramp_time: planned_ramp,
                    rest_time: planned_rest,
                },
            ) => Preparation::GravityRamp {
                ramp_time: ramp_time.unwrap_or(planned_ramp),
                rest_time: rest_time.unwrap_or(planned_rest),
            },
            _ => planned,
        }
    }
}

impl Case {
    /// Parses and validates a case from the content of the file at `path`. The case may be partial: `complete` fills
    /// in what is missing. A complete case is read as by [`Case::parse`].
    ///
    /// # Errors
    /// If the file is no case, or `complete` fails.
    pub fn parse_with(
        content: &[u8],
        path: &Path,
        complete: impl FnOnce(&PartialCase) -> Result<Self, InvalidValue>,
    ) -> Result<Self, CaseError> {
        match Self::parse(content, path) {
            Err(CaseError::Malformed { .. }) => {
                let case = complete(&CaseError::deserialized(content, path)?);
                case.and_then(|case| case.validate().map(|()| case))
                    .map_err(CaseError::in_file(path))
            }
            parsed => parsed,
        }
    }
}
