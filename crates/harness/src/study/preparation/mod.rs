//! The paper's preparation between side walls (its supplement, I.B): the effect of the push A on the force c between
//! the bottom cylinders, and on the yield force F.
//!
//! "c = 0" does not pin the yield force down. It holds for every A up to an [A*](critical_pushes), and F rises
//! with A all the way: the bottom cylinders roll inwards by A/3 before the top one lies on them, and roll
//! out again with it, which leaves tangential forces that the gravity ramp does not.

mod critical;
mod plan;
mod study;

pub use critical::{CriticalPush, critical_pushes};
pub use plan::{PreparationPlan, between_side_walls, plan_preparation};
pub use study::{
    PreparationRow, PreparationStudy, preparation_cases, preparation_studies, study_preparation,
};
