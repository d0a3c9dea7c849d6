//! The convention of a code: the keys that its manifest declares, and those that a probe settles.

use crate::model::{Arms, ContactArms, ContactConvention, HistoryUpdate};
use toml::de::DeTable;

/// A key of a manifest on the convention of a code. Where the manifest leaves it out, the probe measures it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ConventionKey {
    /// `convention.pair.torque_arm`.
    PairTorqueArm,
    /// `convention.pair.kinematic_arm`.
    PairKinematicArm,
    /// `convention.floor.torque_arm`.
    FloorTorqueArm,
    /// `convention.floor.kinematic_arm`.
    FloorKinematicArm,
    /// `convention.coulomb_operand`.
    CoulombOperand,
    /// `convention.sliding_spring`.
    SlidingSpring,
    /// `convention.history_update`.
    HistoryUpdate,
    /// `convention.tensile_force`.
    TensileForce,
    /// `convention.moment_of_inertia`.
    MomentOfInertia,
    /// `integration.velocity_lag`.
    VelocityLag,
}

impl ConventionKey {
    /// All keys, in the order of a manifest.
    pub const ALL: [Self; 10] = [
        Self::PairTorqueArm,
        Self::PairKinematicArm,
        Self::FloorTorqueArm,
        Self::FloorKinematicArm,
        Self::CoulombOperand,
        Self::SlidingSpring,
        Self::HistoryUpdate,
        Self::TensileForce,
        Self::MomentOfInertia,
        Self::VelocityLag,
    ];

    /// The keys that move the quasi-static limit (docs/theory.md, section 2.3).
    pub const ARMS: [Self; 4] = [
        Self::PairTorqueArm,
        Self::PairKinematicArm,
        Self::FloorTorqueArm,
        Self::FloorKinematicArm,
    ];

    /// Returns the key with its tables, separated by dots.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::PairTorqueArm => "convention.pair.torque_arm",
            Self::PairKinematicArm => "convention.pair.kinematic_arm",
            Self::FloorTorqueArm => "convention.floor.torque_arm",
            Self::FloorKinematicArm => "convention.floor.kinematic_arm",
            Self::CoulombOperand => "convention.coulomb_operand",
            Self::SlidingSpring => "convention.sliding_spring",
            Self::HistoryUpdate => "convention.history_update",
            Self::TensileForce => "convention.tensile_force",
            Self::MomentOfInertia => "convention.moment_of_inertia",
            Self::VelocityLag => "integration.velocity_lag",
        }
    }

    /// Whether every value of the key moves the quasi-static limit, as for the arms (docs/theory.md, section 2.3). Of
    /// the rules for a turning spring only one does; the probe recognises it by a separate property
    /// ([`Unknown::moves_limit`]).
    pub fn moves_limit(self) -> bool {
        Self::ARMS.contains(&self)
    }

    /// Sets the coefficient of `arms` that the key names, if it names one, to `value`.
    pub fn set_arm(self, arms: &mut Arms, value: f64) {
        match self {
            Self::PairTorqueArm => arms.pair.torque = value,
            Self::PairKinematicArm => arms.pair.kinematic = value,
            Self::FloorTorqueArm => arms.floor.torque = value,
            Self::FloorKinematicArm => arms.floor.kinematic = value,
            _ => {}
        }
    }

    /// Returns the coefficient of `arms` that the key names; `None` if it names none.
    pub fn arm(self, arms: &Arms) -> Option<f64> {
        Some(match self {
            Self::PairTorqueArm => arms.pair.torque,
            Self::PairKinematicArm => arms.pair.kinematic,
            Self::FloorTorqueArm => arms.floor.torque,
            Self::FloorKinematicArm => arms.floor.kinematic,
            _ => return None,
        })
    }

    /// Copies the value of the key from `from` into `into`. Keys of the integration are in neither.
    pub(super) fn copy(self, from: &ContactConvention, into: &mut ContactConvention) {
        match self {
            Self::CoulombOperand => into.coulomb_operand = from.coulomb_operand,
            Self::SlidingSpring => into.sliding_spring = from.sliding_spring,
            Self::HistoryUpdate => into.history_update = from.history_update,
            Self::TensileForce => into.tensile_force = from.tensile_force,
            Self::MomentOfInertia => into.moment_of_inertia = from.moment_of_inertia,
            _ => {
                if let Some(arm) = self.arm(&from.arms) {
                    self.set_arm(&mut into.arms, arm);
                }
            }
        }
    }

    /// Lists the keys that `manifest` leaves out. A kinematic arm counts as declared where the torque arm is, since
    /// it defaults to the torque arm.
    pub(super) fn left_out_of(manifest: &DeTable) -> Vec<Self> {
        let keys = Self::ALL.into_iter();
        let left_out = keys.filter(|key| match key {
            Self::PairKinematicArm => !key.is_in(manifest) && !Self::PairTorqueArm.is_in(manifest),
            Self::FloorKinematicArm => {
                !key.is_in(manifest) && !Self::FloorTorqueArm.is_in(manifest)
            }
            _ => !key.is_in(manifest),
        });
        left_out.collect()
    }

    fn is_in(self, manifest: &DeTable) -> bool {
        let (tables, key) = self.as_str().rsplit_once('.').unwrap_or_default();
        let inner = tables.split('.').try_fold(manifest, |table, name| {
            table.get(name)?.get_ref().as_table()
        });
        inner.is_some_and(|table| table.contains_key(key))
    }
}

impl std::fmt::Display for ConventionKey {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// The properties that a manifest declares and the probe measures.
#[derive(Debug, Clone, PartialEq)]
pub struct Declaration {
    /// The contact convention, with the paper's values for the keys that are left out. Micro-tests are always asked
    /// for under it, whatever they show.
    pub convention: ContactConvention,
    /// Steps by which reported velocities lag behind reported positions.
    pub velocity_lag: f64,
    /// The keys that the manifest leaves out; they are unknown until they are measured.
    pub left_out: Vec<ConventionKey>,
    /// Whether the code moves spheres in space.
    pub in_space: bool,
}

/// The convention of a code after its probe: what its manifest declares, and what was measured for the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Settled {
    /// The contact convention. Keys that are still unknown have the paper's values.
    pub convention: ContactConvention,
    /// Steps by which reported velocities lag behind reported positions.
    pub velocity_lag: f64,
    /// Steps by which the forces that move the bodies were found to lag behind the positions; 0 for a code that was not
    /// probed.
    pub force_lag: f64,
    /// Whether positions were found to be numbers of 32 bits.
    pub has_single_positions: bool,
    /// Uncertainties of the arm coefficients: 0 for those that are declared.
    pub arm_uncertainty: Arms,
    /// Uncertainty of the moment of inertia: 0 if it is declared.
    pub inertia_uncertainty: f64,
    /// Uncertainty of the velocity lag: 0 if it is declared.
    pub lag_uncertainty: f64,
    /// The keys that the manifest leaves out and the probe does not decide.
    pub unknown: Vec<Unknown>,
}

/// The part of a convention that moves the quasi-static limit, as far as it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownConvention {
    /// Arm coefficients.
    pub arms: Arms<Option<f64>>,
    /// Spring of a turning contact.
    pub history_update: Option<HistoryUpdate>,
}

impl KnownConvention {
    /// That of rigid bodies, which have none.
    pub const NONE: Self = Self {
        arms: Arms {
            pair: ContactArms {
                torque: None,
                kinematic: None,
            },
            floor: ContactArms {
                torque: None,
                kinematic: None,
            },
        },
        history_update: None,
    };
}

impl From<ContactConvention> for KnownConvention {
    fn from(convention: ContactConvention) -> Self {
        Self {
            arms: convention.arms.map(Some),
            history_update: Some(convention.history_update),
        }
    }
}

/// A key that a manifest leaves out and no probe decides.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// The key.
    pub key: ConventionKey,
    /// Why it is not known.
    pub because: String,
    /// Whether the quasi-static limit depends on what is unknown about the key. It depends on any arm, and on whether
    /// a spring turns with its contact, but not on the rule by which the spring turns.
    pub moves_limit: bool,
}

impl Unknown {
    /// Creates the entry for a `key` about which nothing is known, `because` of the given reason.
    pub fn new(key: ConventionKey, because: String) -> Self {
        Self {
            key,
            because,
            moves_limit: key.moves_limit() || key == ConventionKey::HistoryUpdate,
        }
    }

    /// Says in words whether the yield force depends on it.
    pub fn matters(&self) -> &'static str {
        match self.moves_limit {
            true => "the yield force depends on it",
            false => "the yield force does not depend on it",
        }
    }
}

impl Settled {
    /// Returns the value of `key` as a manifest spells it, without quotation marks.
    pub fn value(&self, key: ConventionKey) -> String {
        let path = key.as_str().strip_prefix("convention.");
        let path = path.map(|path| format!("/{}", path.replace('.', "/")));
        let convention = serde_json::to_value(self.convention).unwrap_or_default();
        let value = path.and_then(|path| convention.pointer(&path).cloned());
        match value {
            Some(serde_json::Value::String(word)) => word,
            Some(number) => number.to_string(),
            None => self.velocity_lag.to_string(),
        }
    }

    /// Returns the value of `key` if it is a number.
    pub fn number(&self, key: ConventionKey) -> Option<f64> {
        match key {
            ConventionKey::MomentOfInertia => Some(self.convention.moment_of_inertia),
            ConventionKey::VelocityLag => Some(self.velocity_lag),
            _ => key.arm(&self.convention.arms),
        }
    }

    /// Returns the uncertainty of `key` if its value is a number.
    pub fn uncertainty(&self, key: ConventionKey) -> Option<f64> {
        match key {
            ConventionKey::MomentOfInertia => Some(self.inertia_uncertainty),
            ConventionKey::VelocityLag => Some(self.lag_uncertainty),
            _ => key.arm(&self.arm_uncertainty),
        }
    }

    /// Returns the uncertainties of the arms if any of them was measured.
    pub fn measured_arms(&self) -> Option<Arms> {
        (self.arm_uncertainty != Arms::PAPER).then_some(self.arm_uncertainty)
    }

    /// The sum of the uncertainties of the arms.
    pub fn arms_open(&self) -> f64 {
        let arms = ConventionKey::ARMS.into_iter();
        arms.filter_map(|key| key.arm(&self.arm_uncertainty)).sum()
    }

    /// Whether it is known that springs turn with their contacts, or that they do not.
    pub fn knows_turning(&self) -> bool {
        let is_open = |own: &Unknown| own.key == ConventionKey::HistoryUpdate && own.moves_limit;
        !self.unknown.iter().any(is_open)
    }

    /// Whether everything is known on which the quasi-static limit depends.
    pub fn knows_limit(&self) -> bool {
        !self.unknown.iter().any(|own| own.moves_limit)
    }

    /// Returns what is known of `convention`, under which runs of the code were made.
    pub fn known(&self, convention: &ContactConvention) -> KnownConvention {
        let if_known = |key: ConventionKey| {
            let arm = key.arm(&convention.arms)?;
            self.reason(key).is_none().then_some(arm)
        };
        KnownConvention {
            arms: Arms {
                pair: ContactArms {
                    torque: if_known(ConventionKey::PairTorqueArm),
                    kinematic: if_known(ConventionKey::PairKinematicArm),
                },
                floor: ContactArms {
                    torque: if_known(ConventionKey::FloorTorqueArm),
                    kinematic: if_known(ConventionKey::FloorKinematicArm),
                },
            },
            history_update: self
                .reason(ConventionKey::HistoryUpdate)
                .is_none()
                .then_some(convention.history_update),
        }
    }

    /// Says in words where the contact points are: one sentence for each kind of contact whose arms are not those of the
    /// undeformed body.
    pub fn contact_points(&self) -> Vec<String> {
        let arms = self.known(&self.convention).arms;
        let of_kind = |place: &str, arms: ContactArms<Option<f64>>| {
            let told = match (arms.torque, arms.kinematic) {
                (Some(0.0), Some(0.0)) => return None,
                (None, None) => "where the contact point lies is not known".to_owned(),
                (Some(torque), Some(kinematic)) if torque == kinematic => {
                    format!("the contact point lies {}", contact_point(torque))
                }
                (torque, kinematic) => format!(
                    "the tangential force turns the bodies as if it acted {}, and surfaces move as if they met {}",
                    torque.map_or(NOWHERE.to_owned(), contact_point),
                    kinematic.map_or(NOWHERE.to_owned(), contact_point),
                ),
            };
            Some(format!("{place}, {told}"))
        };
        let told = [
            of_kind("in pairs", arms.pair),
            of_kind("on the floor", arms.floor),
        ];
        told.into_iter().flatten().collect()
    }

    /// Returns why `key` is unknown; `None` if it is known.
    pub fn reason(&self, key: ConventionKey) -> Option<&str> {
        let mut unknown = self.unknown.iter();
        unknown.find_map(|own| (own.key == key).then_some(own.because.as_str()))
    }
}

/// Words for a contact point that is not known.
const NOWHERE: &str = "at a place that is not known";

/// Says where the contact point of an arm r + r₁ × overlap lies, by its `coefficient` r₁.
fn contact_point(coefficient: f64) -> String {
    let side = match coefficient {
        0.0 => return "on the surface of the undeformed body".to_owned(),
        inside if inside < 0.0 => "inside",
        _ => "outside",
    };
    let overlaps = match coefficient.abs() {
        0.5 => "half an overlap".to_owned(),
        1.0 => "one overlap".to_owned(),
        overlaps => format!("{overlaps} overlaps"),
    };
    format!("{overlaps} {side} the surface of the undeformed body")
}

impl Declaration {
    /// Returns the convention of a code that has not been probed, `because` of the given reason: the keys that are
    /// left out are unknown.
    pub fn unsettled(&self, because: &str) -> Settled {
        let unknown = self.left_out.iter();
        Settled {
            convention: self.convention,
            velocity_lag: self.velocity_lag,
            force_lag: 0.0,
            has_single_positions: false,
            arm_uncertainty: Arms::PAPER,
            inertia_uncertainty: 0.0,
            lag_uncertainty: 0.0,
            unknown: unknown
                .map(|&key| Unknown::new(key, because.to_owned()))
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left_out_of(manifest: &str) -> Vec<&'static str> {
        let manifest = DeTable::parse(manifest).unwrap();
        let left_out = ConventionKey::left_out_of(manifest.get_ref()).into_iter();
        left_out.map(ConventionKey::as_str).collect()
    }

    #[test]
    fn contact_points_are_told_where_they_are_not_on_the_undeformed_body() {
        let told = |pair: f64, floor: ContactArms, unknown: &[ConventionKey]| {
            let mut convention = ContactConvention::TURNING;
            convention.arms.pair = ContactArms::reciprocal(pair);
            convention.arms.floor = floor;
            let declaration = Declaration {
                convention,
                velocity_lag: 0.5,
                left_out: unknown.to_vec(),
                in_space: false,
            };
            declaration.unsettled("").contact_points()
        };
        let reciprocal = ContactArms::reciprocal;
        assert!(told(0.0, reciprocal(0.0), &[]).is_empty());
        assert_eq!(
            told(-0.5, reciprocal(-1.5), &[]),
            [
                "in pairs, the contact point lies half an overlap inside the surface of the undeformed body",
                "on the floor, the contact point lies 1.5 overlaps inside the surface of the undeformed body"
            ]
        );
        let apart = ContactArms {
            torque: 1.0,
            kinematic: 0.0,
        };
        assert_eq!(
            told(0.0, apart, &[ConventionKey::FloorKinematicArm]),
            [
                "on the floor, the tangential force turns the bodies as if it acted one overlap outside the surface of the \
                 undeformed body, and surfaces move as if they met at a place that is not known"
            ]
        );
    }

    #[test]
    fn a_kinematic_arm_is_declared_with_the_torque_arm() {
        let all = left_out_of("");
        assert_eq!(all.len(), ConventionKey::ALL.len());
        let without = |keys: &[&str]| -> Vec<&str> {
            let kept = all.iter().filter(|key| !keys.contains(key));
            kept.copied().collect()
        };
        let pair = [
            "convention.pair.torque_arm",
            "convention.pair.kinematic_arm",
        ];
        assert_eq!(
            left_out_of("convention.pair.torque_arm = 0.0"),
            without(&pair)
        );
        assert_eq!(
            left_out_of("convention.pair.kinematic_arm = 0.0"),
            without(&pair[1..])
        );
        assert_eq!(
            left_out_of("integration = { velocity_lag = 0.0 }"),
            without(&["integration.velocity_lag"])
        );
    }
}
