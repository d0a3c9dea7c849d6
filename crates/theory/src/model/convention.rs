//! Contact convention of a code: arms, Coulomb limit, damping, and the treatment of the tangential spring.

use super::Arms;
use super::law::{ContactLaw, Law};
use super::stack::{PAPER_BODIES, Stack};
use super::validity::{InvalidValue, within};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Restitution coefficient e_r of the paper (supplement I.A).
pub const PAPER_RESTITUTION: f64 = 0.7;

/// Moment of inertia of a solid cylinder, m r²/2.
pub const CYLINDER_INERTIA: f64 = 0.5;

/// Moment of inertia of a solid sphere in m r².
const SPHERE_INERTIA: f64 = 0.4;

/// The force that Coulomb's limit μ |f_n| is compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum CoulombOperand {
    /// The whole tangential force, spring and damping.
    SpringAndDamping,
    /// The force of the spring alone; damping is added while the contact sticks, and left out while it
    /// slides.
    Spring,
}

/// Length of the tangential spring while the contact slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum SlidingSpring {
    /// It keeps the length it had when the sliding began.
    Frozen,
    /// It is set, in every step, to the length at which the Coulomb operand is at the limit.
    FollowsLimit,
}

/// Change of the tangential spring when the contact turns by dψ in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum HistoryUpdate {
    /// It is a vector in space that nothing turns: it grows along the present tangent, and once the contact has turned a
    /// part of it lies along the normal. It is not frame-indifferent: the forces between two bodies that turn together
    /// stay where they were.
    Fixed,
    /// It turns with the contact and keeps its length.
    Rotated,
    /// It is projected onto the new tangent, which shortens it by the factor cos dψ.
    Projected,
    /// It is turned by the vector product with the turn, which stretches it by the factor
    /// cos dψ + sin² dψ.
    Linearised,
}

/// Normal force while two surfaces separate so fast that damping exceeds the spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum TensileForce {
    /// The normal force may become negative and pull.
    MayPull,
    /// A negative normal force is set to zero.
    NeverPulls,
}

/// Contact convention of a code.
///
/// Law and arms move the quasi-static limit of the yield force, the arms above μ_c by 20 % and more between existing
/// codes, and so does a spring that nothing turns, by up to 5 %; the rest of a convention shows in trajectories. A key
/// that a case file leaves out has the paper's value, but for `history_update`: springs turn unless a file says
/// otherwise, as they did before there was a choice.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct ContactConvention {
    /// Arm coefficients; the keys `pair` and `floor` of a case file.
    #[serde(flatten)]
    pub arms: Arms,
    /// Growth of the contact forces with the overlap; without this table, linear springs.
    #[serde(skip_serializing_if = "Law::is_linear")]
    pub law: Law,
    /// Restitution coefficient e_r, in (0, 1], of normal and tangential damping.
    pub restitution: f64,
    /// The force that Coulomb's limit is compared with.
    pub coulomb_operand: CoulombOperand,
    /// Spring of a sliding contact.
    pub sliding_spring: SlidingSpring,
    /// Spring of a turning contact.
    pub history_update: HistoryUpdate,
    /// Normal force of a contact that separates.
    pub tensile_force: TensileForce,
    /// Moment of inertia of a cylinder in m r².
    pub moment_of_inertia: f64,
}

impl Default for ContactConvention {
    fn default() -> Self {
        Self::TURNING
    }
}

impl HistoryUpdate {
    /// Every rule.
    pub const ALL: [Self; 4] = [
        Self::Fixed,
        Self::Rotated,
        Self::Projected,
        Self::Linearised,
    ];

    /// The name in case files, in manifests and on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Rotated => "rotated",
            Self::Projected => "projected",
            Self::Linearised => "linearised",
        }
    }

    /// Whether the spring turns with its contact. All rules that do so share one quasi-static limit.
    pub const fn turns(self) -> bool {
        !matches!(self, Self::Fixed)
    }
}

impl ContactConvention {
    /// The paper's convention: arms 0 and 0, linear springs, restitution 0.7, Coulomb's limit on the whole tangential
    /// force, and a spring that is frozen while sliding and does not turn (the integral of v dτ in the paper, and its
    /// program).
    pub const PAPER: Self = Self {
        history_update: HistoryUpdate::Fixed,
        ..Self::TURNING
    };

    /// The paper's convention with a spring that turns with its contact, as in most codes: the default where only arms
    /// or a law are known.
    pub const TURNING: Self = Self {
        arms: Arms::PAPER,
        law: Law::LINEAR,
        restitution: PAPER_RESTITUTION,
        coulomb_operand: CoulombOperand::SpringAndDamping,
        sliding_spring: SlidingSpring::Frozen,
        history_update: HistoryUpdate::Rotated,
        tensile_force: TensileForce::MayPull,
        moment_of_inertia: CYLINDER_INERTIA,
    };

    /// The default convention where only arms, law and number of bodies are given: [`PAPER`](Self::PAPER) if all three
    /// are the paper's, otherwise [`TURNING`](Self::TURNING) with these arms and this law.
    pub fn usual(arms: Arms, law: Law, bodies: u8) -> Self {
        let usual = Self {
            arms,
            law,
            ..Self::TURNING
        };
        match usual == Self::TURNING && bodies == PAPER_BODIES {
            true => Self::PAPER,
            false => usual,
        }
    }

    /// [`TURNING`](Self::TURNING) with other arms.
    pub const fn with_arms(arms: Arms) -> Self {
        Self {
            arms,
            ..Self::TURNING
        }
    }

    /// [`TURNING`](Self::TURNING) with another law.
    pub const fn with_law(law: Law) -> Self {
        Self {
            law,
            ..Self::TURNING
        }
    }

    /// Adapts the convention to the bodies of `stack`: spheres are solid, whatever moment of inertia a code gives its
    /// cylinders.
    #[must_use]
    pub fn of_bodies(self, stack: &Stack) -> Self {
        match stack.bodies {
            PAPER_BODIES => self,
            _ => Self {
                moment_of_inertia: SPHERE_INERTIA,
                ..self
            },
        }
    }

    /// The law of contacts between cylinders at stiffness ratio κ.
    pub fn law(&self, stiffness_ratio: f64) -> ContactLaw {
        self.law.of_pairs(stiffness_ratio, self.restitution)
    }

    /// The law of contacts with walls, where κ is the stiffness ratio of contacts between cylinders.
    pub fn wall_law(&self, stiffness_ratio: f64) -> ContactLaw {
        self.law.of_walls(stiffness_ratio, self.restitution)
    }

    /// Returns the largest slope of any normal force, where κ is the stiffness ratio of contacts between cylinders.
    pub fn highest_stiffness(&self, stiffness_ratio: f64) -> f64 {
        let laws = [self.law(stiffness_ratio), self.wall_law(stiffness_ratio)];
        laws.map(|law| law.highest_stiffness())
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// Whether the quasi-static limit has a closed form: all arms are 0, and springs are linear and turn.
    pub fn has_closed_form(&self) -> bool {
        self.arms == Arms::PAPER && self.law.is_linear() && self.history_update.turns()
    }

    /// Checks every value; the error names the first that is out of range.
    pub fn validate(&self) -> Result<(), InvalidValue> {
        self.arms.validate()?;
        self.law.validate()?;
        within("convention.restitution", self.restitution, 1e-3, 1.0)?;
        // From a solid sphere to a hoop.
        within(
            "convention.moment_of_inertia",
            self.moment_of_inertia,
            0.4,
            1.0,
        )
    }
}

/// Writes the part of the convention that affects the quasi-static limit.
impl fmt::Display for ContactConvention {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Arms { pair, floor } = self.arms;
        write!(formatter, "arms {pair}, {floor}")?;
        if !self.law.is_linear() {
            write!(formatter, ", {}", self.law)?;
        }
        match self.history_update.turns() {
            true => Ok(()),
            false => formatter.write_str(", spring fixed"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Serde promises nothing about `flatten` beside `deny_unknown_fields`.
    #[test]
    fn arms_are_keys_of_the_convention_and_an_unknown_key_is_refused() {
        let read = |text| toml::from_str::<ContactConvention>(text);
        let convention = read("floor = { torque_arm = -1.0 }\nrestitution = 1.0").unwrap();
        assert_eq!(convention.arms, Arms::reciprocal(0.0, -1.0));
        assert_eq!(convention.restitution.to_bits(), 1f64.to_bits());
        for (text, key) in [
            ("arms = {}", "arms"),
            ("restitutoin = 1.0", "restitutoin"),
            ("pair = { torqe_arm = 0.0 }", "torqe_arm"),
        ] {
            let message = read(text).unwrap_err().to_string();
            assert!(
                message.contains(&format!("unknown field `{key}`")),
                "{message}"
            );
        }
    }

    /// A linear law is not written to a file, so that cases keep the hashes from before there were other laws.
    #[test]
    fn a_law_is_a_table_unless_it_is_linear() {
        let written = |law| serde_json::to_value(ContactConvention::with_law(law)).unwrap();
        assert_eq!(written(Law::LINEAR).get("law"), None);
        let hertz = written(Law::HERTZ);
        assert_eq!(hertz["law"]["power"], 1.5);
        let again: ContactConvention = serde_json::from_value(hertz).unwrap();
        assert_eq!(again, ContactConvention::with_law(Law::HERTZ));
    }

    #[test]
    fn what_a_case_leaves_out_is_the_paper_s_but_its_springs_turn() {
        let convention: ContactConvention = serde_json::from_str("{}").unwrap();
        assert_eq!(convention, ContactConvention::TURNING);
        let fixed: ContactConvention =
            serde_json::from_str("{\"history_update\": \"fixed\"}").unwrap();
        assert_eq!(fixed, ContactConvention::PAPER);
    }

    #[test]
    fn a_rule_for_the_spring_has_the_same_word_everywhere() {
        for rule in HistoryUpdate::ALL {
            assert_eq!(serde_json::to_value(rule).unwrap(), rule.as_str());
        }
    }
}
