//! The order in the time step that the distance between a code and its twin must have, and why.

use super::distance::{Branch, Quantity};
use super::plan::Twin;
use crate::code::Code;
use serde::{Deserialize, Serialize};

/// How a distance falls with the time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DocumentedOrder {
    /// It is nothing but round-off.
    RoundOff,
    /// It halves when the step is halved.
    First,
    /// It quarters.
    Second,
    /// It falls irregularly, and only its size is judged.
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Documented {
    /// The order.
    pub order: DocumentedOrder,
    /// Its reason.
    pub reason: &'static str,
}

const SAME_ARITHMETIC: Documented = Documented {
    order: DocumentedOrder::RoundOff,
    reason: "the twin does the same sums in another order",
};
/// Tried out: where native too knows contacts of zero overlap, the distance to YADE is 1e-14 up to the peak, and
/// 3e-10 of second order in the collapse, because YADE's spring, a vector, keeps a small component along the
/// normal when it is turned linearly.
const FIRST_TOUCH: Documented = Documented {
    order: DocumentedOrder::First,
    reason: "YADE knows contacts of zero overlap: its wall, which just touches at row 0, pushes with its \
             damping force for one step that the twin goes without",
};
const TRANSPORT: Documented = Documented {
    order: DocumentedOrder::First,
    reason: "the twin turns a tangential spring with its contact; the code changes its length by a term of \
             second order in the turn, in every step",
};
const SUMMED_SPIN: Documented = Documented {
    order: DocumentedOrder::Second,
    reason: "LIGGGHTS keeps no angle of a sphere; its deck sums the spin by the trapezoidal rule",
};
const TURNED_DIPOLE: Documented = Documented {
    order: DocumentedOrder::Second,
    reason: "LAMMPS turns a dipole by the arctangent of spin times time step, not by their product",
};
const TWO_CAUSES: Documented = Documented {
    order: DocumentedOrder::Irregular,
    reason: "two causes of different order, the transport of the spring and the angle, add up or cancel",
};
const OPENING_CONTACTS: Documented = Documented {
    order: DocumentedOrder::Irregular,
    reason: "contacts open and meet again between two steps, and the step decides when: not even the twin \
             converges regularly to itself",
};

/// The documented order of the distance in `quantity` on `branch` between `code` and its `twin`.
pub fn documented(code: Code, twin: Twin, quantity: Quantity, branch: Branch) -> Documented {
    use Code::{Lammps, Liggghts, Native, Yade, YadeFacet, YadeWall};
    let angle = match code {
        Liggghts => Some(SUMMED_SPIN),
        Lammps => Some(TURNED_DIPOLE),
        Native | Yade | YadeFacet | YadeWall => None,
    };
    let same_steps = twin == Twin::Full && matches!(code, Native | Liggghts | Lammps);
    match (quantity, angle) {
        (Quantity::Theta2, Some(angle)) if same_steps => angle,
        _ if same_steps => SAME_ARITHMETIC,
        _ if branch == Branch::Fall => OPENING_CONTACTS,
        (Quantity::Theta2, Some(_)) => TWO_CAUSES,
        _ if matches!(code, Yade | YadeFacet | YadeWall)
            && (twin == Twin::Full || branch == Branch::Compression) =>
        {
            FIRST_TOUCH
        }
        _ => TRANSPORT,
    }
}
