//! The kind of evidence behind a row, and what it does not prove.

use super::judgement::Judgement;
use crate::study::Source;

/// Kinds of evidence, strongest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Evidence {
    /// Our own code against the solution in closed form.
    ClosedForm,
    /// An independent code, its convention measured here, against the limit under that convention.
    IndependentCode,
    /// Files that were made elsewhere after a plan, against the same limit.
    ResultFiles,
    /// A run recorded elsewhere, by an independent code, against the same limit.
    RecordedRun,
}

impl Evidence {
    /// All kinds, strongest first.
    pub const ALL: [Self; 4] = [
        Self::ClosedForm,
        Self::IndependentCode,
        Self::ResultFiles,
        Self::RecordedRun,
    ];

    /// The evidence of a row.
    pub fn of(judgement: &Judgement) -> Self {
        match judgement.source {
            Source::Recorded => Self::RecordedRun,
            Source::Files => Self::ResultFiles,
            Source::Live if judgement.code.is_native() => Self::ClosedForm,
            Source::Live => Self::IndependentCode,
        }
    }

    /// The words in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::IndependentCode => "independent code",
            Self::ResultFiles => "result files",
            Self::RecordedRun => "recorded run",
        }
    }

    /// One sentence on what an agreement does not prove.
    pub fn does_not_prove(self) -> &'static str {
        match self {
            Self::ClosedForm => {
                "that the model is the right one for real cylinders, or that the stepping is right beyond \
                 the quasi-static limit: theory and stepping are by the same authors and share the model"
            }
            Self::IndependentCode => {
                "that the code is right in other contact laws or geometries, for many bodies or away from the \
                 quasi-static limit, or that its convention is the physical one"
            }
            Self::ResultFiles => {
                "more than a run of an independent code, nor that the files were made by the program and the \
                 version that they are said to be of: nobody here has seen it run"
            }
            Self::RecordedRun => {
                "that the code on your machine gives the same: it only shows that nothing on our side has \
                 changed since the runs were recorded"
            }
        }
    }
}
