//! Verdicts, and the grounds they are derived from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The verdict on a measured number, from best to worst. Only `agrees` is a pass.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Within the tolerance.
    Agrees,
    /// The uncertainty is larger than the tolerance, or something else speaks against an agreement.
    Inconclusive,
    /// Off by more than both tolerance and uncertainty.
    Differs,
    /// The series, or the theory, shows no yield.
    NoYield,
    /// The code is not installed, and no recorded run stands in for it.
    Missing,
    /// The code failed.
    Failed,
}

impl Verdict {
    /// All of them, from best to worst.
    pub const ALL: [Self; 6] = [
        Self::Agrees,
        Self::Inconclusive,
        Self::Differs,
        Self::NoYield,
        Self::Missing,
        Self::Failed,
    ];

    /// The verdict on a number with this `error`, known to within `uncertainty`, where `tolerance` is allowed.
    pub fn of(error: f64, uncertainty: f64, tolerance: f64) -> Self {
        if error.abs() > tolerance.max(uncertainty) {
            Self::Differs
        } else if uncertainty > tolerance || !error.is_finite() || !uncertainty.is_finite() {
            Self::Inconclusive
        } else {
            Self::Agrees
        }
    }

    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Differs => "differs",
            Self::Inconclusive => "inconclusive",
            Self::NoYield => "no-yield",
            Self::Failed => "failed",
            Self::Missing => "missing",
        }
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// What kind of reason keeps a row from agreeing, where its numbers alone do not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// The code has a mechanism that the model does not have, or lacks one of it.
    AnotherModel,
    /// The probe contradicts what the manifest declares or the task asks for.
    Contradicted,
    /// A part of the convention is left out of the manifest, and the probe does not show it.
    NotKnown,
    /// The probe was made with another program than the runs, or there is none.
    NotProbed,
    /// Numbers in single precision leave the result too uncertain.
    SinglePrecision,
    /// Numbers are printed with so few digits that they leave the result too uncertain.
    FewDigits,
    /// The uncertainty is larger than what may be.
    TooCoarse,
    /// The numbers show nothing.
    Undecidable,
    /// The numbers agree, but something else speaks against them.
    Doubtful,
}

impl Cause {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::AnotherModel,
        Self::Contradicted,
        Self::NotKnown,
        Self::NotProbed,
        Self::SinglePrecision,
        Self::FewDigits,
        Self::TooCoarse,
        Self::Undecidable,
        Self::Doubtful,
    ];

    /// The words in messages.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::AnotherModel => "another model",
            Self::Contradicted => "contradicted by its probe",
            Self::NotKnown => "convention not known",
            Self::NotProbed => "not probed",
            Self::SinglePrecision => "single precision",
            Self::FewDigits => "few digits",
            Self::TooCoarse => "too coarse",
            Self::Undecidable => "not decidable",
            Self::Doubtful => "doubtful",
        }
    }

    /// Whether the code is known to be another one than it is meant to be.
    fn contradicts(self) -> bool {
        matches!(self, Self::AnotherModel | Self::Contradicted)
    }
}

/// A ground for or against a row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Ground {
    /// A number was compared with its expected value.
    Deviation {
        /// Measured minus expected.
        error: f64,
        /// Expanded uncertainty of the error.
        uncertainty: f64,
        /// Largest error that agrees.
        tolerance: f64,
        /// Note that is shown if it does not agree.
        note: Option<String>,
    },
    /// A required condition holds.
    Held,
    /// A required condition is violated.
    Violation(String),
    /// A required condition is violated, but would hold if the forces that move the bodies were those of the step
    /// before.
    LateForces(String),
    /// A reason to doubt an agreement; without a worse ground the row is inconclusive.
    Doubt(String),
    /// Deviations up to `up_to` decide nothing; larger ones still differ.
    Blur {
        /// The largest deviation that decides nothing.
        up_to: f64,
        /// The reason.
        note: String,
    },
    /// The numbers are there, but nothing can be decided by them.
    Undecidable(String),
    /// An explanation without influence on the verdict.
    Remark(String),
    /// The same: numbers of the code are in single precision.
    SinglePrecision(String),
    /// Nothing yields, with the reason if it is known.
    NoYield(Option<String>),
    /// The code failed.
    Failed(String),
    /// A run, or a number, is missing.
    Missing(String),
    /// The reference belongs to a convention that the code does not have, or is not known to have.
    NotJudged {
        /// The reason.
        note: String,
        /// Its kind.
        cause: Cause,
    },
}

/// Says that a `quantity` of a row exceeds its `tolerance`, with enough digits to tell the two apart.
fn exceeds(quantity: &str, value: f64, tolerance: f64) -> String {
    let shown = |digits: usize| [value, tolerance].map(|number| format!("{number:.digits$e}"));
    let told_apart = (1..17)
        .map(shown)
        .find(|[value, tolerance]| value != tolerance);
    let [value, tolerance] = told_apart.unwrap_or_else(|| shown(1));
    format!("the {quantity} {value} exceeds the tolerance {tolerance}")
}

impl Ground {
    fn note(&self) -> Option<&str> {
        match self {
            Self::Deviation { note, .. } => match self.verdict(0.0) {
                Some(Verdict::Agrees) => None,
                _ => note.as_deref(),
            },
            Self::NoYield(note) => note.as_deref(),
            Self::Held => None,
            Self::Violation(note)
            | Self::LateForces(note)
            | Self::Doubt(note)
            | Self::Blur { note, .. }
            | Self::Undecidable(note)
            | Self::Remark(note)
            | Self::SinglePrecision(note)
            | Self::Failed(note)
            | Self::Missing(note)
            | Self::NotJudged { note, .. } => Some(note),
        }
    }

    /// Describes in words the numbers of a comparison that does not agree; `None` for every other ground.
    fn comparison(&self) -> Option<String> {
        let &Self::Deviation {
            error,
            uncertainty,
            tolerance,
            ..
        } = self
        else {
            return None;
        };
        match self.verdict(0.0)? {
            Verdict::Agrees => None,
            Verdict::Inconclusive => Some(exceeds("uncertainty", uncertainty, tolerance)),
            _ => Some(exceeds("error", error, tolerance)),
        }
    }

    /// The verdict that this ground alone would give; `None` if it gives none. Deviations up to `blur` decide
    /// nothing.
    fn verdict(&self, blur: f64) -> Option<Verdict> {
        match *self {
            Self::Deviation {
                error,
                uncertainty,
                tolerance,
                ..
            } => Some(match Verdict::of(error, uncertainty, tolerance) {
                Verdict::Differs if error.abs() <= blur => Verdict::Inconclusive,
                verdict => verdict,
            }),
            Self::Held => Some(Verdict::Agrees),
            Self::Violation(_) | Self::LateForces(_) => Some(Verdict::Differs),
            Self::Doubt(_) | Self::Blur { .. } | Self::Undecidable(_) | Self::NotJudged { .. } => {
                Some(Verdict::Inconclusive)
            }
            Self::NoYield(_) => Some(Verdict::NoYield),
            Self::Failed(_) => Some(Verdict::Failed),
            Self::Missing(_) => Some(Verdict::Missing),
            Self::Remark(_) | Self::SinglePrecision(_) => None,
        }
    }
}

/// The grounds for and against a row, and the one place where its verdict is derived.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grounds(Vec<Ground>);

impl Grounds {
    /// No grounds yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a ground.
    pub(crate) fn add(&mut self, ground: Ground) {
        self.0.push(ground);
    }

    /// Adds a condition that must hold; `violation` is the note if it does not.
    pub fn hold(&mut self, holds: bool, violation: &str) {
        self.add(match holds {
            true => Ground::Held,
            false => Ground::Violation(violation.to_owned()),
        });
    }

    /// Turns violations that follow from late forces into a remark, since the code is known to have them.
    pub(crate) fn allow_late_forces(&mut self) {
        let is_late = |ground: &Ground| matches!(ground, Ground::LateForces(_));
        let late: Vec<String> = self
            .0
            .extract_if(.., |ground| is_late(ground))
            .filter_map(|ground| ground.note().map(str::to_owned))
            .collect();
        let Some(first) = late.first() else {
            return;
        };
        let further = match late.len() {
            1 => String::new(),
            count => format!(" (and {} more)", count - 1),
        };
        self.add(Ground::Remark(format!(
            "forces that are late by a step take damping away, so that the stack rings longer: {first}{further}"
        )));
    }

    /// Adds the comparison of a number with its expected value; `note` explains a disagreement.
    pub fn compare(&mut self, error: f64, uncertainty: f64, tolerance: f64, note: Option<String>) {
        self.add(Ground::Deviation {
            error,
            uncertainty,
            tolerance,
            note,
        });
    }

    /// The largest deviation that decides nothing.
    fn blur(&self) -> f64 {
        let blurs = self.0.iter().map(|ground| match ground {
            Ground::Blur { up_to, .. } => *up_to,
            _ => 0.0,
        });
        blurs.fold(0.0, f64::max)
    }

    /// Derives the verdict.
    ///
    /// 1. A failed or missing run leaves nothing to judge.
    /// 2. Without the right reference, or where nothing can be decided, the row is inconclusive.
    /// 3. Otherwise the worst ground counts: no yield, then a deviation or violation, then a doubt.
    /// 4. Without any comparison or condition the row is inconclusive.
    pub fn verdict(&self) -> Verdict {
        let blur = self.blur();
        let each = self.0.iter().filter_map(|ground| ground.verdict(blur));
        let worst = each.max().unwrap_or(Verdict::Inconclusive);
        let is_open =
            |ground: &Ground| matches!(ground, Ground::Undecidable(_) | Ground::NotJudged { .. });
        match worst {
            Verdict::Missing | Verdict::Failed => worst,
            _ if self.0.iter().any(is_open) => Verdict::Inconclusive,
            _ => worst,
        }
    }

    /// Notes that explain the verdict: first why nothing can be judged, then those of the grounds that decide it, last
    /// remarks.
    pub fn notes(&self) -> Vec<&str> {
        let (verdict, blur) = (self.verdict(), self.blur());
        let rank = |ground: &&Ground| match (ground, ground.verdict(blur)) {
            (Ground::NotJudged { .. }, _) => 0,
            (Ground::Undecidable(_), _) => 1,
            (_, Some(own)) if own == verdict => 2,
            (_, Some(_)) => 3,
            (_, None) => 4,
        };
        let mut noted: Vec<&Ground> = self.0.iter().filter(|own| own.note().is_some()).collect();
        noted.sort_by_key(rank);
        noted.into_iter().filter_map(Ground::note).collect()
    }

    /// The kind of reason why the row is inconclusive; `None` if it is not, or nothing was compared.
    pub fn cause(&self) -> Option<Cause> {
        if self.verdict() != Verdict::Inconclusive {
            return None;
        }
        let blur = self.blur();
        let is_coarse = |ground: &Ground| match ground {
            Ground::Deviation { .. } => ground.verdict(blur) == Some(Verdict::Inconclusive),
            _ => false,
        };
        let is_single = |ground: &Ground| matches!(ground, Ground::SinglePrecision(_));
        let of = |ground: &Ground| {
            Some(match ground {
                Ground::NotJudged { cause, .. } => *cause,
                Ground::Undecidable(_) => Cause::Undecidable,
                own if is_coarse(own) && self.0.iter().any(is_single) => Cause::SinglePrecision,
                own if is_coarse(own) => Cause::TooCoarse,
                Ground::Doubt(_) | Ground::Blur { .. } => Cause::Doubtful,
                _ => return None,
            })
        };
        let rank = |cause: &Cause| match cause {
            Cause::AnotherModel | Cause::Contradicted => 0,
            Cause::NotKnown | Cause::NotProbed => 1,
            Cause::Undecidable => 2,
            Cause::SinglePrecision | Cause::FewDigits => 3,
            Cause::TooCoarse => 4,
            Cause::Doubtful => 5,
        };
        self.0.iter().filter_map(of).min_by_key(rank)
    }

    /// The verdict in words, with the kind of reason if it is inconclusive.
    pub fn in_words(&self) -> String {
        let verdict = self.verdict();
        match self.cause() {
            Some(cause) => format!("{verdict} ({})", cause.as_str()),
            None => verdict.to_string(),
        }
    }

    /// Why the verdict is not `agrees`, in one line: the notes, or the numbers of the comparisons that decide.
    pub fn reason(&self) -> String {
        let notes = self.notes();
        if !notes.is_empty() {
            return notes.join("; ");
        }
        let reasons: Vec<String> = self.0.iter().filter_map(Ground::comparison).collect();
        reasons.join("; ")
    }

    /// Error and tolerance of the first comparison; `None` where the reference is not the right one.
    pub fn deviation(&self) -> Option<(f64, f64)> {
        self.0
            .iter()
            .filter(|_| self.is_judged())
            .find_map(|ground| match ground {
                Ground::Deviation {
                    error, tolerance, ..
                } => Some((*error, *tolerance)),
                _ => None,
            })
    }

    /// Whether the reference is the right one.
    pub fn is_judged(&self) -> bool {
        let not_judged = |ground: &Ground| matches!(ground, Ground::NotJudged { .. });
        !self.0.iter().any(not_judged)
    }

    /// Whether the row is not judged because the code is known to have another convention than it declares.
    pub fn is_contradicted(&self) -> bool {
        let is_contradicted = |ground: &Ground| match ground {
            Ground::NotJudged { cause, .. } => cause.contradicts(),
            _ => false,
        };
        self.0.iter().any(is_contradicted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grounds(grounds: &[Ground]) -> Grounds {
        Grounds(grounds.to_vec())
    }

    fn deviation(error: f64) -> Ground {
        Ground::Deviation {
            error,
            uncertainty: 0.5,
            tolerance: 1.0,
            note: Some(format!("off by {error}")),
        }
    }

    #[test]
    fn nothing_compared_is_no_agreement() {
        assert_eq!(Grounds::new().verdict(), Verdict::Inconclusive);
        let remark = Ground::Remark("a remark".to_owned());
        assert_eq!(grounds(&[remark]).verdict(), Verdict::Inconclusive);
    }

    #[test]
    fn a_condition_holds_or_is_noted() {
        let held = |holds: bool| {
            let mut grounds = Grounds::new();
            grounds.hold(holds, "it is broken");
            (grounds.verdict(), grounds.reason())
        };
        assert_eq!(held(true), (Verdict::Agrees, String::new()));
        assert_eq!(held(false), (Verdict::Differs, "it is broken".to_owned()));
    }

    #[test]
    fn what_decides_is_told_first_and_remarks_last() {
        let notes = [
            Ground::Remark("a remark".to_owned()),
            Ground::Doubt("a doubt".to_owned()),
            Ground::Violation("a violation".to_owned()),
        ];
        let told = grounds(&notes);
        assert_eq!(told.notes(), ["a violation", "a doubt", "a remark"]);
        let mut open = told;
        open.add(Ground::NotJudged {
            note: "not judged".to_owned(),
            cause: Cause::NotKnown,
        });
        assert_eq!(open.cause(), Some(Cause::NotKnown));
        let notes = open.notes();
        assert_eq!(notes, ["not judged", "a doubt", "a violation", "a remark"]);
    }

    #[test]
    fn the_cause_is_that_of_the_ground_that_decides() {
        let coarse = Ground::Deviation {
            error: 0.1,
            uncertainty: 2.0,
            tolerance: 1.0,
            note: None,
        };
        let doubt = Ground::Doubt("a doubt".to_owned());
        let not_judged = |cause| Ground::NotJudged {
            note: "not judged".to_owned(),
            cause,
        };
        let words = |list: &[Ground]| grounds(list).in_words();
        assert_eq!(words(&[deviation(0.1)]), "agrees");
        assert_eq!(words(&[deviation(3.0), doubt.clone()]), "differs");
        assert_eq!(
            words(std::slice::from_ref(&doubt)),
            "inconclusive (doubtful)"
        );
        let mut list = vec![doubt, coarse];
        assert_eq!(words(&list), "inconclusive (too coarse)");
        list.push(not_judged(Cause::FewDigits));
        assert_eq!(words(&list), "inconclusive (few digits)");
        list.pop();
        list.push(Ground::SinglePrecision("32 bits".to_owned()));
        assert_eq!(words(&list), "inconclusive (single precision)");
        list.push(not_judged(Cause::NotKnown));
        assert_eq!(words(&list), "inconclusive (convention not known)");
        list.push(not_judged(Cause::AnotherModel));
        assert_eq!(words(&list), "inconclusive (another model)");
        assert!(grounds(&list).is_contradicted());
    }

    #[test]
    fn late_forces_violate_unless_the_code_is_known_to_have_them() {
        let late = |note: &str| Ground::LateForces(note.to_owned());
        let mut both = grounds(&[late("run 1"), deviation(0.1), late("run 2")]);
        assert_eq!(both.verdict(), Verdict::Differs);
        both.allow_late_forces();
        assert_eq!(both.verdict(), Verdict::Agrees);
        let told = both.notes();
        assert!(told[0].ends_with("run 1 (and 1 more)"), "{told:?}");
    }

    #[test]
    fn the_worst_ground_decides() {
        let doubt = Ground::Doubt("a doubt".to_owned());
        let violation = Ground::Violation("a violation".to_owned());
        for (list, verdict) in [
            (vec![deviation(0.1)], Verdict::Agrees),
            (vec![deviation(0.1), doubt.clone()], Verdict::Inconclusive),
            (vec![deviation(3.0), doubt], Verdict::Differs),
            (vec![deviation(0.1), violation], Verdict::Differs),
            (
                vec![deviation(3.0), Ground::Undecidable(String::new())],
                Verdict::Inconclusive,
            ),
            (
                vec![deviation(0.1), Ground::NoYield(None)],
                Verdict::NoYield,
            ),
            (
                vec![Ground::NoYield(None), Ground::Missing(String::new())],
                Verdict::Missing,
            ),
            (
                vec![
                    Ground::Missing(String::new()),
                    Ground::Failed(String::new()),
                ],
                Verdict::Failed,
            ),
            (
                vec![
                    Ground::Undecidable(String::new()),
                    Ground::Missing(String::new()),
                ],
                Verdict::Missing,
            ),
        ] {
            assert_eq!(grounds(&list).verdict(), verdict, "{list:?}");
        }
    }

    #[test]
    fn a_blur_hides_deviations_up_to_its_size_and_no_larger_ones() {
        let blur = Ground::Blur {
            up_to: 2.0,
            note: "a blur".to_owned(),
        };
        for (error, verdict) in [
            (0.1, Verdict::Inconclusive),
            (1.5, Verdict::Inconclusive),
            (2.5, Verdict::Differs),
        ] {
            assert_eq!(
                grounds(&[deviation(error), blur.clone()]).verdict(),
                verdict
            );
        }
    }

    #[test]
    fn a_row_with_the_wrong_reference_is_not_judged_by_it() {
        let not_judged = Ground::NotJudged {
            note: "another arm".to_owned(),
            cause: Cause::Contradicted,
        };
        let judged = grounds(&[Ground::Held, deviation(3.0)]);
        assert_eq!(judged.deviation(), Some((3.0, 1.0)));
        assert!(judged.is_judged() && !judged.is_contradicted());
        let grounds = grounds(&[deviation(3.0), not_judged]);
        assert_eq!(grounds.verdict(), Verdict::Inconclusive);
        assert_eq!(grounds.deviation(), None);
        assert!(!grounds.is_judged() && grounds.is_contradicted());
    }

    #[test]
    fn only_a_deviation_that_does_not_agree_is_explained() {
        assert!(grounds(&[deviation(0.1)]).notes().is_empty());
        assert_eq!(grounds(&[deviation(3.0)]).notes(), ["off by 3"]);
        let unsaid = |error, uncertainty| Ground::Deviation {
            error,
            uncertainty,
            tolerance: 1.0,
            note: None,
        };
        assert_eq!(
            grounds(&[unsaid(3.0, 0.5)]).reason(),
            "the error 3.0e0 exceeds the tolerance 1.0e0"
        );
        assert_eq!(
            grounds(&[unsaid(0.1, 2.0)]).reason(),
            "the uncertainty 2.0e0 exceeds the tolerance 1.0e0"
        );
        assert_eq!(grounds(&[unsaid(0.1, 0.5)]).reason(), "");
        // With as many digits as tell them apart.
        assert_eq!(
            grounds(&[unsaid(1.004, 0.5)]).reason(),
            "the error 1.004e0 exceeds the tolerance 1.000e0"
        );
    }

    #[test]
    fn only_a_small_error_that_is_known_well_agrees() {
        assert_eq!(Verdict::of(0.5, 0.5, 1.0), Verdict::Agrees);
        assert_eq!(Verdict::of(-2.0, 0.5, 1.0), Verdict::Differs);
        assert_eq!(Verdict::of(0.5, 2.0, 1.0), Verdict::Inconclusive);
        assert_eq!(Verdict::of(3.0, 2.0, 1.0), Verdict::Differs);
        assert_eq!(Verdict::of(f64::NAN, 0.0, 1.0), Verdict::Inconclusive);
        assert_eq!(Verdict::of(0.0, f64::NAN, 1.0), Verdict::Inconclusive);
    }

    #[test]
    fn what_is_just_allowed_agrees() {
        assert_eq!(Verdict::of(1.0, 0.5, 1.0), Verdict::Agrees);
        assert_eq!(Verdict::of(-1.0, 1.0, 1.0), Verdict::Agrees);
        assert_eq!(Verdict::of(2.0, 2.0, 1.0), Verdict::Inconclusive);
    }

    #[test]
    fn the_word_in_tables_is_the_one_in_files() {
        for (verdict, word) in [
            (Verdict::Agrees, "agrees"),
            (Verdict::Differs, "differs"),
            (Verdict::Inconclusive, "inconclusive"),
            (Verdict::NoYield, "no-yield"),
            (Verdict::Failed, "failed"),
            (Verdict::Missing, "missing"),
        ] {
            assert_eq!(verdict.to_string(), word);
            assert_eq!(serde_json::to_value(verdict).unwrap(), word);
        }
    }
}
