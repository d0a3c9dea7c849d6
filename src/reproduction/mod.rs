//! What the paper did, done again.

mod preparation;

pub use preparation::{
    CriticalPush, Estimator, PreparationPlan, PreparationRow, PreparationStudy, between_side_walls,
    critical_pushes, plan_preparation, study_preparation,
};
