//! Numbers of the task, one of which may be another one in the code: the value with which the native DEM gives the series.

use super::beside::Beside;
use super::factor::{meanings, of_factor, of_friction};
use super::mistake::{Mistake, minimum};
use crate::model::{Case, Preparation};

/// Range in which factors are looked for, and the number of factors that are tried first.
const LARGEST_FACTOR: f64 = 30.0;
const FIRST_TRIES: i32 = 12;

/// A number of the task that may be another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Parameter {
    FloorFriction,
    PairFriction,
    NormalStiffness,
    PairStiffness,
    FloorStiffness,
    WallStiffness,
    TangentialStiffness,
    PairTangentialStiffness,
    FloorTangentialStiffness,
    Damping,
    Gravity,
    WallSpeed,
    TimeStep,
}

impl Parameter {
    pub const ALL: [Self; 13] = [
        Self::FloorFriction,
        Self::PairFriction,
        Self::NormalStiffness,
        Self::PairStiffness,
        Self::FloorStiffness,
        Self::WallStiffness,
        Self::TangentialStiffness,
        Self::PairTangentialStiffness,
        Self::FloorTangentialStiffness,
        Self::Damping,
        Self::Gravity,
        Self::WallSpeed,
        Self::TimeStep,
    ];

    /// The name in messages, and the value that was asked for.
    fn asked(self, case: &Case) -> (&'static str, f64) {
        let law = case.convention.law(case.stack.stiffness_ratio);
        match self {
            Self::FloorFriction => ("floor_friction", case.stack.floor_friction),
            Self::PairFriction => ("cylinder_friction", case.stack.cylinder_friction),
            Self::NormalStiffness => ("normal_stiffness", law.normal_stiffness),
            Self::PairStiffness => ("normal_stiffness between cylinders", law.normal_stiffness),
            Self::FloorStiffness => ("normal_stiffness of the floor", law.normal_stiffness),
            Self::WallStiffness => ("normal_stiffness of the top wall", law.normal_stiffness),
            Self::TangentialStiffness => ("tangential_stiffness", law.tangential_stiffness),
            Self::PairTangentialStiffness => (
                "tangential_stiffness between cylinders",
                law.tangential_stiffness,
            ),
            Self::FloorTangentialStiffness => (
                "tangential_stiffness of the floor",
                law.tangential_stiffness,
            ),
            Self::Damping => ("damping_normal and damping_tangential", law.damping_normal),
            Self::Gravity => (
                "gravity, or the mass on which it acts,",
                case.stack.epsilon(),
            ),
            Self::WallSpeed => ("wall_speed", case.protocol.wall_speed),
            Self::TimeStep => ("time_step", case.protocol.time_step),
        }
    }

    /// The mistake in which it is `factor` times what was asked for.
    fn mistaken(self, case: &Case, factor: f64) -> Mistake {
        let mut mistake = Mistake::new(case, "");
        let (law, protocol) = (&mut mistake.law, &mut mistake.case.protocol);
        match self {
            Self::FloorFriction => law.floor.friction = factor,
            Self::PairFriction => law.pair.friction = factor,
            Self::NormalStiffness => law.everywhere(|change| change.normal_stiffness = factor),
            Self::PairStiffness => law.pair.normal_stiffness = factor,
            Self::FloorStiffness => law.floor.normal_stiffness = factor,
            Self::WallStiffness => law.wall.normal_stiffness = factor,
            Self::TangentialStiffness => {
                law.everywhere(|change| change.tangential_stiffness = factor)
            }
            Self::PairTangentialStiffness => law.pair.tangential_stiffness = factor,
            Self::FloorTangentialStiffness => law.floor.tangential_stiffness = factor,
            Self::Damping => law.everywhere(|change| {
                (change.normal_damping, change.tangential_damping) = (factor, factor);
            }),
            Self::Gravity => mistake.case.stack.stiffness /= factor,
            Self::WallSpeed => {
                protocol.wall_speed *= factor;
                protocol.wall_travel *= factor;
                protocol.sampling.fine_from_travel *= factor;
            }
            Self::TimeStep => {
                protocol.time_step *= factor;
                protocol.wall_travel *= factor;
                protocol.sampling.fine_from_travel *= factor;
                protocol.sampling.fine_interval *= factor;
                protocol.sampling.coarse_interval *= factor;
                if let Preparation::GravityRamp {
                    ramp_time,
                    rest_time,
                } = &mut protocol.preparation
                {
                    *ramp_time *= factor;
                    *rest_time *= factor;
                }
            }
        }
        mistake
    }

    /// The value with which the native DEM comes nearest to what was found, if that explains it.
    pub fn fit(self, beside: &Beside, case: &Case) -> Option<(f64, String)> {
        let distance = |exponent: f64| {
            let rows = self.mistaken(case, exponent.exp()).rows();
            rows.map_or(f64::INFINITY, |rows| beside.distance_of_run(&rows))
        };
        let spacing = LARGEST_FACTOR.ln() / f64::from(FIRST_TRIES);
        let tries = (-FIRST_TRIES..=FIRST_TRIES).map(|index| f64::from(index) * spacing);
        let nearest = tries.min_by(|left, right| distance(*left).total_cmp(&distance(*right)))?;
        let factor = minimum(&distance, nearest - spacing, nearest + spacing).exp();
        let rows = self.mistaken(case, factor).rows()?;
        let rest = beside.explained_by(&rows)?;
        Some((rest, self.described(case, factor)))
    }

    fn described(self, case: &Case, factor: f64) -> String {
        let (name, asked) = self.asked(case);
        let stack = &case.stack;
        let (value, kappa) = (asked * factor, stack.stiffness_ratio);
        let mut fitting = match self {
            Self::FloorFriction => of_friction(value, asked, stack.cylinder_friction),
            Self::PairFriction => of_friction(value, asked, stack.floor_friction),
            _ => of_factor(factor, stack.epsilon()),
        };
        let is_shear = [
            Self::TangentialStiffness,
            Self::PairTangentialStiffness,
            Self::FloorTangentialStiffness,
        ]
        .contains(&self);
        if is_shear {
            let own = [
                (kappa * kappa, "k_n and k_t are exchanged in their ratio"),
                (kappa, "k_t = k_n: the normal stiffness serves for both"),
            ];
            fitting.extend(meanings(
                factor,
                &own.map(|(value, meaning)| (value, meaning.to_owned())),
            ));
        }
        let fitting = match fitting.is_empty() {
            true => String::new(),
            false => format!(": {}", fitting.join("; or ")),
        };
        format!("the series is that of {name} = {value:.6} in place of {asked:.6}{fitting}")
    }
}
