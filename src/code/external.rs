//! An external code as an code: which program, which decks, and tasks handed to it in batches.

use super::batch::Batch;
use super::installation::{self, Installation, VersionQuestion};
use super::task::{Deck, ParameterFile, Task};
use super::tasks::Tasks;
use super::{Batching, Code, Environment, Failure, Finished, InstalledCode, RunContext};
use crate::code::{Identity, Provenance, Run};
use crate::model::{Case, ContactTest, InvalidValue, Preparation, Pyramid, sha256_hex};
use crate::series::PyramidRun;
use std::ops::Range;

/// What has to be known about an external code.
pub struct Adapter {
    pub(super) name: Code,
    /// Program in the search path.
    pub(super) program: &'static str,
    /// How it says its version.
    pub(super) version: VersionQuestion,
    /// Variables of its environment.
    pub(super) environment: Environment,
    /// Files of its own, in the working directory, that say what went wrong.
    pub(super) logs: &'static [&'static str],
    pub(super) parameter_file: ParameterFile,
    /// How it compresses a stack after a gravity ramp.
    pub(super) stack: Deck<Case>,
    /// How it compresses a stack that was prepared between side walls, if it can.
    pub(super) side_walls: Option<Deck<Case>>,
    /// How it carries out a micro-test.
    pub(super) probe: Deck<ContactTest>,
    /// How it carries out the run of a pyramid, if it can.
    pub(super) pyramid: Option<Deck<Pyramid>>,
    /// A build of the same code that computes with more digits.
    pub(super) precise_program: Option<&'static str>,
}

impl Adapter {
    /// The deck with which it runs a case with `preparation`; `None` if it has none.
    pub(super) fn deck(&self, preparation: &Preparation) -> Option<&Deck<Case>> {
        match preparation {
            Preparation::GravityRamp { .. } => Some(&self.stack),
            Preparation::SideWalls(_) => self.side_walls.as_ref(),
        }
    }

    /// Hash of the files of a deck.
    pub(super) fn static_hash<T: Task>(&self, deck: &Deck<T>) -> String {
        let files = deck
            .files
            .iter()
            .map(|(name, content)| format!("{name}\n{content}\n"));
        sha256_hex(files.collect::<String>().as_bytes())
    }

    /// All but the files of the deck that one task is carried out with, as one text.
    pub(super) fn told<T: Task>(&self, deck: &Deck<T>, task: &T) -> String {
        let arguments = (deck.arguments)(&[".".to_owned()]);
        let content = self.parameter_file.content(&task.parameters());
        let file = self.parameter_file.name();
        format!("{file}\n{content}\n{arguments:?}\n{:?}", self.environment)
    }
}

/// An external code that is installed.
pub struct ExternalCode {
    pub(super) adapter: &'static Adapter,
    /// Program in the search path: that of the adapter, or a build of it in another precision.
    pub(super) program: &'static str,
    pub(super) installation: Installation,
    identity: Identity,
}

impl ExternalCode {
    /// The code as it is installed here.
    pub(super) fn find(adapter: &'static Adapter) -> Option<Box<dyn InstalledCode>> {
        Self::find_program(adapter, adapter.program)
    }

    /// The code as the `program`, which takes the same decks.
    pub(super) fn find_program(
        adapter: &'static Adapter,
        program: &'static str,
    ) -> Option<Box<dyn InstalledCode>> {
        let installation = installation::find(program, &adapter.version, adapter.environment)?;
        let identity = Identity {
            code: adapter.name.as_str().to_owned(),
            version: installation.version.clone(),
            package: installation.package.clone(),
            program_hash: Some(installation.hash.clone()),
        };
        Some(Box::new(Self {
            adapter,
            program,
            installation,
            identity,
        }))
    }

    /// Program and arguments that carry out the tasks in `directories`.
    pub(super) fn command<T: Task>(&self, deck: &Deck<T>, directories: &[String]) -> Vec<String> {
        let mut command = vec![self.program.to_owned()];
        command.extend((deck.arguments)(directories));
        command
    }

    /// Carries out those of `tasks` in `range`, in order, as many at once as the code can; if
    /// `all_or_nothing`, only up to the first failure.
    fn carry_out_with<T: Task>(
        &self,
        deck: &Deck<T>,
        tasks: &[T],
        range: Range<usize>,
        context: &RunContext,
        all_or_nothing: bool,
        finished: Finished<(T::Outcome, f64)>,
    ) {
        let many = deck.completion_file.is_some();
        let at_once = if many { range.len() } else { 1 };
        let mut next = range.start;
        while next < range.end {
            let end = (next + at_once).min(range.end);
            let directory = if tasks.len() == 1 {
                context.directory.to_owned()
            } else {
                context.directory.join(format!("{}-{next}", self.program))
            };
            let mut batch = Batch::new(self, deck, &tasks[next..end], directory);
            let mut failed = false;
            batch.run(context, &mut |index, result| {
                failed |= result.is_err();
                finished(next + index, result);
            });
            if failed && all_or_nothing {
                return;
            }
            next += batch.settled();
        }
    }
}

/// Whether two cases are run with the same deck.
fn same_deck(left: &Case, right: &Case) -> bool {
    let kind = |case: &Case| std::mem::discriminant(&case.protocol.preparation);
    let short = |case: &Case| case.protocol.shortcuts.is_some();
    kind(left) == kind(right) && short(left) == short(right)
}

impl ExternalCode {
    /// Runs those of `cases` in `range`.
    fn run_with(
        &self,
        deck: &Deck<Case>,
        cases: &[Case],
        range: Range<usize>,
        context: &RunContext,
        finished: Finished<Run>,
    ) {
        self.carry_out_with(deck, cases, range, context, false, &mut |index, result| {
            let case = cases[index];
            let run = result.map(|(series, seconds)| Run {
                case,
                series,
                provenance: Provenance::now(
                    self.identity.clone(),
                    self.adapter.name.deck_hash(&case),
                    self.command(deck, &[".".to_owned()]),
                    case.steps(),
                    seconds,
                ),
            });
            finished(index, run);
        });
    }

    /// Carries out `tasks` with `deck`, up to the first failure.
    fn up_to_failure<T: Task>(
        &self,
        deck: &Deck<T>,
        tasks: &[T],
        context: &RunContext,
        finished: Finished<T::Outcome>,
    ) {
        let all = 0..tasks.len();
        self.carry_out_with(deck, tasks, all, context, true, &mut |index, result| {
            finished(index, result.map(|(outcome, _)| outcome));
        });
    }

    /// Runs `cases`, those that share a deck together.
    fn run_cases(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>) {
        let mut start = 0;
        for same in cases.chunk_by(same_deck) {
            let range = start..start + same.len();
            start = range.end;
            match self.deck_of(&same[0]) {
                Ok(deck) => self.run_with(deck, cases, range, context, finished),
                Err(_) => {
                    for index in range {
                        if let Err(refusal) = self.deck_of(&cases[index]) {
                            finished(index, Err(*refusal));
                        }
                    }
                }
            }
        }
    }

    /// Runs `pyramids`, if all are valid and there is a deck for them.
    fn run_pyramids(
        &self,
        pyramids: &[Pyramid],
        context: &RunContext,
        finished: Finished<PyramidRun>,
    ) {
        for (index, pyramid) in pyramids.iter().enumerate() {
            if let Err(refusal) = self.pyramid_deck(pyramid) {
                let failure = Failure::unsupported(self.adapter.name, pyramid, refusal);
                return finished(index, Err(failure));
            }
        }
        if let Some(deck) = &self.adapter.pyramid {
            self.up_to_failure(deck, pyramids, context, finished);
        }
    }

    fn pyramid_deck(&self, pyramid: &Pyramid) -> Result<&Deck<Pyramid>, InvalidValue> {
        pyramid.validate()?;
        let deck = self.adapter.pyramid.as_ref();
        deck.ok_or_else(|| self.adapter.name.unknown_pyramid())
    }

    /// The deck for `case`, or what becomes of a case that the code cannot run.
    fn deck_of(&self, case: &Case) -> Result<&Deck<Case>, Box<Failure>> {
        let name = self.adapter.name;
        let preparation = &case.protocol.preparation;
        let deck = self.adapter.deck(preparation);
        let accepted = name.check_shortcuts(case.protocol.shortcuts.is_some());
        accepted
            .and_then(|()| deck.ok_or_else(|| name.unknown_preparation(preparation)))
            .map_err(|refusal| Box::new(Failure::unsupported(name, case, refusal)))
    }
}

impl InstalledCode for ExternalCode {
    fn name(&self) -> Code {
        self.adapter.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn batching(&self) -> Batching {
        match self.adapter.stack.completion_file {
            Some(_) => Batching::FewCalls,
            None => Batching::OneCallACase,
        }
    }

    fn carry_out(&self, tasks: Tasks, context: &RunContext) {
        match tasks {
            Tasks::Cases(cases, finished) => self.run_cases(cases, context, finished),
            Tasks::ContactTests(tests, finished) => {
                self.up_to_failure(&self.adapter.probe, tests, context, finished);
            }
            Tasks::Pyramids(pyramids, finished) => self.run_pyramids(pyramids, context, finished),
        }
    }
}
