//! A code under the one convention that plans, references and verdicts hold it to.

use super::convention::Settled;
use super::described::Code;
use super::task::as_of_cylinders;
use crate::model::{Case, ContactConvention, InvalidValue, Law, Power};
use std::sync::Arc;

/// A code with its settled convention: what its manifest declares, and what a probe measured for the keys left out.
///
/// Whatever plans, computes references or judges takes a settled code, so that nobody forgets to settle a convention:
///
/// ```
/// use tristack_harness::code::Code;
/// use tristack_harness::model::Stack;
/// use tristack_harness::study::yield_force::plan;
///
/// let code = Code::named("liggghts").expect("it is built in");
/// let settled = code.as_declared().expect("its manifest leaves nothing out");
/// let measurement = plan(&settled, &Stack::paper(0.3, 1e3), settled.convention());
/// assert_eq!(measurement.cases.len(), 5);
/// ```
///
/// ```compile_fail
/// # use tristack_harness::code::Code;
/// # use tristack_harness::model::{ContactConvention, Stack};
/// # use tristack_harness::study::yield_force::plan;
/// let code = Code::named("liggghts").expect("it is built in");
/// plan(&code, &Stack::paper(0.3, 1e3), ContactConvention::PAPER);
/// ```
#[derive(Clone, PartialEq)]
pub struct SettledCode {
    code: Code,
    settled: Arc<Settled>,
}

impl SettledCode {
    /// The DEM of this program, with the paper's convention as its default.
    pub fn native() -> Self {
        Code::native().unmeasured("")
    }

    /// Returns the codes of this program whose normal force grows with this power of the overlap, as their manifests
    /// declare them; that of the native code may grow with any.
    pub fn with_power(power: Power) -> Vec<Self> {
        let codes = Code::with_power(power).into_iter();
        codes.filter_map(|code| code.as_declared()).collect()
    }

    /// Combines `code` with the convention that its probe has settled.
    pub fn new(code: Code, settled: Settled) -> Self {
        Self {
            code,
            settled: Arc::new(settled),
        }
    }

    /// The code itself; its name does not depend on what is settled.
    pub fn name(&self) -> &Code {
        &self.code
    }

    /// Its convention, with the uncertainties of what was measured and the keys that are still unknown.
    pub fn settled(&self) -> &Settled {
        &self.settled
    }

    /// Its contact convention, with the paper's values for unknown keys. The native code accepts any convention; its
    /// default is the paper's.
    pub fn convention(&self) -> ContactConvention {
        self.settled.convention
    }

    /// Returns its convention for stacks of so many bodies with a law of this power: the usual one if the convention
    /// belongs to the case, its own otherwise.
    pub fn stack_convention(&self, power: Power, bodies: u8) -> ContactConvention {
        let own = self.convention();
        match self.code.accepts_any_convention() {
            true => ContactConvention::usual(own.arms, Law::of_power(power), bodies),
            false => own,
        }
    }

    /// Refuses a convention that differs from the settled one; the restitution is a parameter of every code.
    pub fn check_convention(&self, asked: &ContactConvention) -> Result<(), InvalidValue> {
        self.code.check_declared(asked)?;
        let mut own = *asked;
        for key in self.code.declaration().left_out {
            key.copy(&self.convention(), &mut own);
        }
        self.code.refuse_difference(asked, &own)
    }

    /// Refuses a case under another convention than the settled one, or with a stiffness ratio that the code cannot
    /// have.
    ///
    /// # Errors
    /// The first key that is refused, with what the code accepts.
    pub fn check_case(&self, case: &Case) -> Result<(), InvalidValue> {
        self.code.check_convention_of(case)?;
        self.check_convention(&as_of_cylinders(case, &self.convention()))
    }
}

impl Code {
    /// Returns the code under its declaration; `None` if that leaves something out, which a probe has to settle
    /// first.
    pub fn as_declared(&self) -> Option<SettledCode> {
        let declaration = self.declaration();
        let complete = declaration.left_out.is_empty();
        complete.then(|| SettledCode::new(self.clone(), declaration.unsettled("")))
    }

    /// Returns the code before any probe, `because` of the given reason: the keys that its manifest leaves out are
    /// unknown, so that no verdict is derived from them.
    pub fn unmeasured(&self, because: &str) -> SettledCode {
        SettledCode::new(self.clone(), self.declaration().unsettled(because))
    }
}

impl std::fmt::Debug for SettledCode {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Debug::fmt(&self.code, formatter)
    }
}

#[cfg(test)]
impl SettledCode {
    /// Returns the code of this name, which must declare everything.
    pub(crate) fn named(name: &str) -> Self {
        let code = Code::named(name).expect("it is built in");
        code.as_declared().expect("nothing is left out")
    }
}
