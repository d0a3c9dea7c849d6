//! The dimensionless groups of the problem.

use super::validity::{InvalidValue, positive, within};
use super::{Arrangement, ContactConvention, Material, Power, Ring};
use serde::{Deserialize, Serialize};

/// Rigid critical floor friction μ_c = 2 − √3 = tan 15° (paper, below Eq. 3), as the nearest double.
pub const CRITICAL_FRICTION: f64 = 0.267_949_192_431_122_7;

/// Stiffness ratio κ = k_n/k_t of the paper (supplement I.A).
pub const PAPER_STIFFNESS_RATIO: f64 = 2.5;

/// Cylinder–cylinder friction μ_d of the paper (supplement I.A).
pub const PAPER_CYLINDER_FRICTION: f64 = 0.7;

const LOWEST_STIFFNESS: f64 = 1.0;

/// Highest stiffness 1/ε of a run.
const HIGHEST_STIFFNESS: f64 = 1e8;

/// Highest stiffness of theory, where forces still have the exponents and prefactors of stiff stacks to five digits
/// (tests/physics/hertz/asymptotics.rs).
pub(super) const HIGHEST_STIFFNESS_OF_THEORY: f64 = 1e16;

/// Number n of bottom bodies in the paper's stack.
pub const PAPER_BODIES: u8 = 2;

/// Accepted range of the number n of bottom bodies.
pub const BODIES_RANGE: (u8, u8) = (PAPER_BODIES, 5);

const HIGHEST_FRICTION: f64 = 1e3;
const HIGHEST_STIFFNESS_RATIO: f64 = 1e6;

/// Three equal cylinders under gravity on a rough floor, or equal spheres: three to five in a ring and one on top.
/// When a stack is deserialised, every key is required except `bodies` and `arrangement`; a case file may spell it in
/// other ways.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stack {
    /// Friction coefficient μ between cylinder and floor.
    pub floor_friction: f64,
    /// Friction coefficient μ_d between two cylinders.
    pub cylinder_friction: f64,
    /// Stiffness 1/ε = k_n r/(m g); K rᵖ/(m g) for a law of power p, in which the force of a pair is K δᵖ.
    pub stiffness: f64,
    /// Stiffness ratio κ = k_n/k_t.
    pub stiffness_ratio: f64,
    /// Number n of bodies on the floor: 2, the paper's cylinders, or 3 to 5 spheres in a ring, with one on top.
    #[serde(default = "paper_bodies", skip_serializing_if = "are_cylinders")]
    pub bodies: u8,
    /// How spheres are placed and numbered.
    #[serde(default, skip_serializing_if = "Arrangement::is_usual")]
    pub arrangement: Arrangement,
}

pub(super) fn paper_bodies() -> u8 {
    PAPER_BODIES
}

/// Leaves `bodies` out of the paper's stack, which keeps the hashes from before there were spheres.
fn are_cylinders(bodies: &u8) -> bool {
    *bodies == PAPER_BODIES
}

impl Stack {
    /// A stack with the paper's stiffness ratio and cylinder friction.
    pub fn paper(floor_friction: f64, stiffness: f64) -> Self {
        Self {
            floor_friction,
            cylinder_friction: PAPER_CYLINDER_FRICTION,
            stiffness,
            stiffness_ratio: PAPER_STIFFNESS_RATIO,
            bodies: PAPER_BODIES,
            arrangement: Arrangement::default(),
        }
    }

    /// Where the bodies are when they just touch.
    pub fn ring(&self) -> Ring {
        Ring::new(self.bodies)
    }

    /// n + 1, weight of all bodies in m g.
    pub fn own_weight(&self) -> f64 {
        f64::from(self.bodies) + 1.0
    }

    /// F + n + 1, the load on the floor under the wall force F, both in m g.
    pub fn floor_load(&self, force: f64) -> f64 {
        force + self.own_weight()
    }

    /// The load on the floor in k_n r, the unit of series.
    pub fn floor_force(&self, wall_force: f64) -> f64 {
        wall_force + self.own_weight() * self.epsilon()
    }

    /// Default κ for a law of this power: the paper's, or that of Poisson's ratio 0.3.
    pub fn usual_stiffness_ratio(power: Power) -> f64 {
        match power {
            Power::Linear => PAPER_STIFFNESS_RATIO,
            _ => Material::USUAL_STIFFNESS_RATIO,
        }
    }

    /// ε = m g/(k_n r), which is also gravity in units of k_n r/m; for a law of power p, K rᵖ⁻¹ replaces k_n.
    pub fn epsilon(&self) -> f64 {
        1.0 / self.stiffness
    }

    /// Upper bound of the frequencies of the stack with all its contacts, in √(k_n/m): ω² ≤ (4 + 12/κ) k/m for
    /// cylinders and (5 + 18/κ) k/m for solid spheres (largest eigenvalues, computed for κ from 1e-3 to 100). k is the
    /// highest stiffness of all contacts, and κ the lowest ratio.
    pub fn highest_frequency(&self, convention: &ContactConvention) -> f64 {
        let stiffness = convention.highest_stiffness(self.stiffness_ratio);
        let ratio = convention.law.lowest_stiffness_ratio(self.stiffness_ratio);
        let [normal, tangential] = match self.bodies {
            PAPER_BODIES => [4.0, 12.0],
            _ => [5.0, 18.0],
        };
        (stiffness * (normal + tangential / ratio)).sqrt()
    }

    /// √(m/k) of the contacts with cylinder 1 under its weight, in √(m/k_n), and at least 1, the value of linear
    /// springs.
    pub fn time_scale(&self, convention: &ContactConvention) -> f64 {
        let law = convention.law(self.stiffness_ratio);
        let stiffness = law.stiffness(law.overlap(self.epsilon() / f64::from(self.bodies)));
        stiffness.sqrt().recip().max(1.0)
    }

    /// The longest time step of a stable integration, in √(m/k_n). Leapfrog is stable up to 2/ω of the stiffest mode;
    /// a safety factor of 0.6 is applied.
    pub fn longest_time_step(&self, convention: &ContactConvention) -> f64 {
        const SAFETY: f64 = 0.6;
        SAFETY * 2.0 / self.highest_frequency(convention)
    }

    /// Checks every value for a run; the error names the first that is out of range.
    pub fn validate(&self) -> Result<(), InvalidValue> {
        self.validate_up_to(HIGHEST_STIFFNESS)
    }

    /// Checks every value, where stiffnesses are accepted up to `highest`.
    pub(super) fn validate_up_to(&self, highest: f64) -> Result<(), InvalidValue> {
        self.validate_bodies()?;
        self.validate_arrangement()?;
        self.validate_floor_friction()?;
        positive(
            "stack.cylinder_friction",
            self.cylinder_friction,
            HIGHEST_FRICTION,
        )?;
        let key = "stack.stiffness";
        within(key, self.stiffness, LOWEST_STIFFNESS, highest)?;
        positive(
            "stack.stiffness_ratio",
            self.stiffness_ratio,
            HIGHEST_STIFFNESS_RATIO,
        )
    }

    /// Checks the floor friction alone.
    pub(super) fn validate_floor_friction(&self) -> Result<(), InvalidValue> {
        let key = "stack.floor_friction";
        positive(key, self.floor_friction, HIGHEST_FRICTION)
    }

    /// Checks that the number of bodies makes a ring which carries a body on top.
    pub fn validate_bodies(&self) -> Result<(), InvalidValue> {
        let (fewest, most) = BODIES_RANGE;
        let accepted = format!(
            "a whole number from {fewest} to {most}: six that touch in a ring lie around a seventh and do not carry it"
        );
        self.bodies_are((fewest..=most).contains(&self.bodies), &accepted)
    }

    /// "cylinders" or "spheres".
    pub fn kind(&self) -> &'static str {
        match self.bodies {
            PAPER_BODIES => "cylinders",
            _ => "spheres",
        }
    }

    /// Refuses spheres: everything but the limit is for the paper's cylinders only.
    pub fn refuse_spheres(&self) -> Result<(), InvalidValue> {
        let accepted = format!("{PAPER_BODIES}, or left out: this is about cylinders alone");
        self.bodies_are(self.bodies == PAPER_BODIES, &accepted)
    }

    fn bodies_are(&self, accepts: bool, accepted: &str) -> Result<(), InvalidValue> {
        match accepts {
            true => Ok(()),
            false => Err(InvalidValue::new(
                "stack.bodies",
                f64::from(self.bodies),
                accepted,
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn critical_friction_is_two_minus_root_three() {
        // μ_c is a root of μ² − 4μ + 1, where the derivative is −2√3: one ulp of μ_c changes the value by 2e-16.
        let mu = CRITICAL_FRICTION;
        assert!((mu * mu - 4.0 * mu + 1.0).abs() < 2e-16);
        assert!((mu - libm::tan(std::f64::consts::PI / 12.0)).abs() < 1e-16);
    }

    #[test]
    fn epsilon_is_the_inverse_of_the_stiffness() {
        assert_eq!(Stack::paper(0.3, 1e4).epsilon(), 1e-4);
    }

    #[test]
    fn two_to_five_bodies_are_accepted_and_two_are_not_written() {
        let of = |bodies| Stack {
            bodies,
            ..Stack::paper(0.3, 1e4)
        };
        for bodies in 2..=5 {
            let stack = of(bodies);
            assert_eq!(stack.validate(), Ok(()));
            assert_eq!(stack.own_weight(), f64::from(bodies) + 1.0);
            let json = serde_json::to_string(&stack).unwrap();
            assert_eq!(json.contains("bodies"), bodies != 2, "{json}");
            assert_eq!(serde_json::from_str::<Stack>(&json).unwrap(), stack);
            assert_eq!(stack.refuse_spheres().is_ok(), bodies == 2);
        }
        for bodies in [0, 1, 6, 255] {
            let refusal = of(bodies).validate().unwrap_err().to_string();
            assert!(refusal.contains("`stack.bodies`") && refusal.contains("from 2 to 5"));
        }
    }
}
