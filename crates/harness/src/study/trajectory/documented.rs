//! The documented order, in the time step, of the distance between a code and its twin, with the reason.

use super::distance::{Branch, Quantity};
use super::plan::Twin;
use crate::code::{Angle, Code};
use serde::{Deserialize, Serialize};

/// How a distance falls with the time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DocumentedOrder {
    /// Round-off only.
    RoundOff,
    /// Halves with the time step.
    First,
    /// Quarters when the time step is halved.
    Second,
    /// Irregular: only the size is judged.
    Irregular,
}

impl DocumentedOrder {
    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::RoundOff => "round-off",
            Self::First => "first",
            Self::Second => "second",
            Self::Irregular => "irregular",
        }
    }
}

/// An order, and the difference in the algorithms that it comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Documented {
    /// The order.
    pub order: DocumentedOrder,
    /// The reason.
    pub reason: String,
}

impl Documented {
    fn new(order: DocumentedOrder, reason: impl Into<String>) -> Self {
        let reason = reason.into();
        Self { order, reason }
    }

    fn same_arithmetic() -> Self {
        let reason = "the twin does the same sums in another order";
        Self::new(DocumentedOrder::RoundOff, reason)
    }

    /// The order for a code with contacts of zero overlap. An experiment with YADE confirms it: if the native code
    /// has them too, the distance is 1e-14 up to the peak. In the collapse it is 3e-10 and of second order, because
    /// YADE's spring is a vector that keeps a small component along the normal when it is turned linearly.
    fn first_touch(code: &Code) -> Self {
        let reason = format!(
            "{} knows contacts of zero overlap: its wall, which just touches at row 0, pushes with its damping \
             force for one step that the twin goes without",
            code.title()
        );
        Self::new(DocumentedOrder::First, reason)
    }

    fn transport() -> Self {
        let reason = "the twin turns a tangential spring with its contact; the code changes its length by a term \
                      of second order in the turn, in every step";
        Self::new(DocumentedOrder::First, reason)
    }

    /// The difference in the angles, if there is one.
    fn angle(code: &Code, quantity: Quantity) -> Option<Self> {
        let angle = match (quantity, code.integration().angle) {
            (Quantity::Theta2, angle) => angle,
            // For spheres every deck sums the spin.
            (Quantity::Rotations, Angle::Dipole) => Angle::SummedSpin,
            (Quantity::Rotations, angle) => angle,
            _ => return None,
        };
        let does = match angle {
            Angle::Exact => return None,
            Angle::SummedSpin => {
                "keeps no angle of a sphere; its deck sums the spin by the trapezoidal rule"
            }
            Angle::Dipole => {
                "turns a dipole by the arctangent of spin times time step, not by their product"
            }
        };
        let reason = format!("{} {does}", code.title());
        Some(Self::new(DocumentedOrder::Second, reason))
    }

    fn two_causes() -> Self {
        let reason = "two causes of different order, the transport of the spring and the angle, add up or cancel";
        Self::new(DocumentedOrder::Irregular, reason)
    }

    fn opening_contacts() -> Self {
        let reason = "contacts open and meet again between two steps, and the step decides when: not even the \
                      twin converges regularly to itself";
        Self::new(DocumentedOrder::Irregular, reason)
    }
}

/// The documented order of the distance in `quantity` on `branch` between `code` and its `twin`.
pub fn documented(code: &Code, twin: Twin, quantity: Quantity, branch: Branch) -> Documented {
    let angle = Documented::angle(code, quantity);
    let touches = code.integration().touches_at_zero_overlap;
    let full = twin == Twin::Full;
    match angle {
        angle if full && !touches => angle.unwrap_or_else(Documented::same_arithmetic),
        _ if branch == Branch::Fall => Documented::opening_contacts(),
        Some(_) => Documented::two_causes(),
        None if touches && (full || branch == Branch::Compression) => Documented::first_touch(code),
        None => Documented::transport(),
    }
}
