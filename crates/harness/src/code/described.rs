//! The codes: those whose folders are part of this program, and those whose folders were given by path.

use super::convention::Declaration;
use super::difference::difference;
use super::folder::{BUILT_IN, Folder};
use super::manifest::{Definition, Integration, Mark, RefusedOutside, RefusedValues, TaskKind};
use super::manifest_error::{ManifestError, Place, refused};
use super::search_path::{SEARCH_PATH, find_not_executable, find_program};
use crate::model::{
    ContactConvention, InvalidValue, Law, PAPER_BODIES, Power, Preparation, Stack, shell_quoted,
    shown,
};
use serde::{Serialize, Serializer};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};
use std::time::Duration;

/// A code as its folder describes it. Codes are ordered as in tables and figures: those of this program first.
#[derive(Clone)]
pub struct Code(Arc<Described>);

#[derive(Clone)]
struct Described {
    definition: Definition,
    /// Its place among the codes of this program; codes given by path come after them.
    place: usize,
    /// The folder that it was read from; absent for a code of this program.
    folder: Option<PathBuf>,
    /// The variants of its folder that come before it.
    earlier: Vec<Code>,
    /// Number of codes before it whose manifests choose no mark.
    turn: usize,
}

/// The codes whose folders are part of this program. The native one is the first.
static BUILT_IN_CODES: LazyLock<Vec<Code>> = LazyLock::new(|| {
    let mut codes = Vec::new();
    for folder in BUILT_IN {
        let read = Definition::read_folder(Folder::BuiltIn(folder));
        let read = read.expect("a folder of this program is in order");
        codes.extend(Code::of_folder(read, codes.len(), None));
    }
    codes
});

impl Code {
    /// The DEM of this program.
    pub fn native() -> Self {
        BUILT_IN_CODES[0].clone()
    }

    /// Whether it is the DEM of this program.
    pub fn is_native(&self) -> bool {
        self.0.place == 0
    }

    /// The codes whose folders are part of this program.
    pub fn built_in() -> Vec<Self> {
        BUILT_IN_CODES.clone()
    }

    /// Returns the codes of this program whose normal force grows with this power of the overlap; that of the native
    /// code may grow with any.
    pub fn with_power(power: Power) -> Vec<Self> {
        let mut codes = Self::built_in();
        codes.retain(|code| code.has_power(power));
        codes
    }

    /// Whether its normal force grows with this power of the overlap.
    pub fn has_power(&self, power: Power) -> bool {
        self.accepts_any_convention() || self.law().power == power
    }

    /// The code of this program with the given `name`.
    pub fn named(name: &str) -> Option<Self> {
        let mut codes = BUILT_IN_CODES.iter();
        codes.find(|code| code.as_str() == name).cloned()
    }

    /// Makes the codes of `definitions`, all from one folder: the one at `path`, or one of this program, whose first
    /// code gets `place`.
    fn of_folder(definitions: Vec<Definition>, place: usize, path: Option<&Path>) -> Vec<Self> {
        let mut codes = Vec::new();
        for (index, definition) in definitions.into_iter().enumerate() {
            let code = Self(Arc::new(Described {
                definition,
                place: place.saturating_add(index),
                folder: path.map(Path::to_owned),
                earlier: codes.clone(),
                turn: 0,
            }));
            codes.push(code);
        }
        codes
    }

    /// Reads the codes in `folder`, in the order of their names.
    ///
    /// # Errors
    /// If the folder describes no code, one without a program, or one with the name of a code of this program.
    pub fn all_in_folder(folder: &Path) -> Result<Vec<Self>, ManifestError> {
        let place = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let read = Definition::read(folder)?;
        if let Some(new) = read.iter().find(|new| Self::named(&new.name).is_some()) {
            return Err(taken(new));
        }
        if let Some(new) = read.iter().find(|new| new.program.is_none()) {
            let message = format!(
                "{} has no [program]; accepted is one with a command",
                new.name
            );
            return Err(ManifestError::new(new.place.clone(), &message));
        }
        Ok(Self::of_folder(read, usize::MAX, Some(&place)))
    }

    /// Returns `codes` in the order of tables, each once. Codes whose manifests choose no mark get one in turn.
    ///
    /// # Errors
    /// If two of them have the same name, because tables tell codes apart by name.
    pub fn side_by_side(codes: &[Self]) -> Result<Vec<Self>, ManifestError> {
        let mut beside: Vec<Self> = Vec::new();
        let mut turn = 0;
        for code in Self::distinct(codes) {
            if beside.iter().any(|own| own.as_str() == code.as_str()) {
                return Err(taken(code.definition()));
            }
            beside.push(Self(Arc::new(Described {
                turn,
                ..Described::clone(&code.0)
            })));
            turn += usize::from(code.mark().is_none());
        }
        Ok(beside)
    }

    /// Returns the distinct `codes`, in the order of tables.
    pub fn distinct<'a>(codes: impl IntoIterator<Item = &'a Self>) -> Vec<Self> {
        let codes: BTreeSet<&Self> = codes.into_iter().collect();
        codes.into_iter().cloned().collect()
    }

    /// Returns the code in `folder` with the given `name`. Without a name, returns the only code, or the one that is
    /// named like the manifest.
    ///
    /// # Errors
    /// If the folder describes no such code, or a code whose name is taken.
    pub fn in_folder(folder: &Path, name: Option<&str>) -> Result<Self, ManifestError> {
        let codes = Self::all_in_folder(folder)?;
        let wanted = |code: &&Code| match name {
            Some(name) => code.as_str() == name,
            None => codes.len() == 1 || code.as_str() == code.definition().family,
        };
        codes.iter().find(wanted).cloned().ok_or_else(|| {
            let names: Vec<&str> = codes.iter().map(Self::as_str).collect();
            let asked = name.unwrap_or("no name");
            let message = format!("{asked} is given; accepted is one of {}", names.join(", "));
            ManifestError::of_folder(folder, &message)
        })
    }

    pub(super) fn definition(&self) -> &Definition {
        &self.0.definition
    }

    /// The name on the command line and in tables.
    pub fn as_str(&self) -> &str {
        &self.definition().name
    }

    /// The name in prose, which the variants of a folder share.
    pub fn title(&self) -> &str {
        &self.definition().title
    }

    /// The name in figures.
    pub fn label(&self) -> String {
        let Definition { title, label, .. } = self.definition();
        match label {
            Some(label) => format!("{title}, {label}"),
            None => title.clone(),
        }
    }

    /// The program, which its versions and styles share.
    pub fn software(&self) -> &str {
        &self.definition().software
    }

    /// The contact style, the same in all versions of the program.
    pub fn style(&self) -> &str {
        &self.definition().style
    }

    /// The mark in figures, if the manifest chooses one.
    pub fn mark(&self) -> Option<Mark> {
        self.definition().mark
    }

    /// Its turn among the codes of a command whose manifests choose no mark.
    pub fn turn(&self) -> usize {
        self.0.turn
    }

    /// Whether it is the first variant of its folder, which represents the others where one is enough.
    pub fn is_first_variant(&self) -> bool {
        self.0.earlier.is_empty()
    }

    /// Whether an earlier variant of its folder declares the same contacts.
    pub fn repeats_another(&self) -> bool {
        let own = self.as_declared();
        own.is_some_and(|own| {
            let mut declared = self.0.earlier.iter().filter_map(Self::as_declared);
            declared.any(|earlier| earlier.convention() == own.convention())
        })
    }

    /// Its contact law, which every manifest declares. The native code accepts any law; its default is the paper's.
    pub fn law(&self) -> Law {
        self.definition().convention.law
    }

    /// Properties of its time integration. The velocity lag may be left out ([`Self::declaration`]).
    pub(crate) fn integration(&self) -> Integration {
        self.definition().integration
    }

    /// The properties that its manifest declares.
    pub fn declaration(&self) -> Declaration {
        let definition = self.definition();
        Declaration {
            convention: definition.convention,
            velocity_lag: definition.integration.velocity_lag,
            left_out: definition.left_out.clone(),
            in_space: definition.runs(TaskKind::SpheresMotion),
        }
    }

    /// Whether its bodies are rigid, so that its contacts have no convention and no stiffness.
    pub fn is_rigid(&self) -> bool {
        self.definition().is_rigid()
    }

    /// Whether its folder is part of this program.
    pub(crate) fn is_built_in(&self) -> bool {
        self.0.folder.is_none()
    }

    /// Whether the convention belongs to the case rather than to the code.
    pub fn accepts_any_convention(&self) -> bool {
        self.is_native()
    }

    /// Refuses a convention that contradicts the declaration of the code. The keys that its manifest leaves out may
    /// have any value. The restitution is a parameter of every code; some of its values may be refused.
    pub(crate) fn check_declared(&self, asked: &ContactConvention) -> Result<(), InvalidValue> {
        if self.accepts_any_convention() {
            return Ok(());
        }
        let restitution = asked.restitution;
        if let Some(RefusedValues { values, because }) = &self.definition().refused.restitution
            && values.contains(&restitution)
        {
            let accepted = format!("any other number for {self}: {because}");
            return Err(refused("convention.restitution", restitution, accepted));
        }
        let mut own = ContactConvention {
            restitution,
            ..self.definition().convention
        };
        for key in &self.definition().left_out {
            key.copy(asked, &mut own);
        }
        self.refuse_difference(asked, &own)
    }

    /// Refuses a convention that differs from the code's `own`.
    pub(super) fn refuse_difference(
        &self,
        asked: &ContactConvention,
        own: &ContactConvention,
    ) -> Result<(), InvalidValue> {
        difference(asked, own).map_or(Ok(()), |(key, value, own)| {
            let key = format!("convention.{key}");
            Err(refused(&key, value, format!("{own} for {self}")))
        })
    }

    /// Refuses a stiffness ratio that the code cannot have.
    pub fn check_stiffness_ratio(&self, asked: f64) -> Result<(), InvalidValue> {
        let limits = &self.definition().refused.stiffness_ratio;
        let refusal = limits
            .as_ref()
            .and_then(|RefusedOutside { outside, because }| {
                let [least, most] = *outside;
                let accepted = format!("a number from {least} to {most} for {self}: {because}");
                let is_inside = (least..=most).contains(&asked);
                (!is_inside).then(|| refused("stack.stiffness_ratio", asked, accepted))
            });
        refusal.map_or(Ok(()), Err)
    }

    /// Refuses a preparation for which the code has no deck.
    pub fn check_preparation(
        &self,
        stack: &Stack,
        asked: &Preparation,
    ) -> Result<(), InvalidValue> {
        self.check_task(TaskKind::of(stack, asked))
    }

    /// Whether it has a deck for pyramids.
    pub fn builds_pyramids(&self) -> bool {
        self.definition().runs(TaskKind::Pyramid)
    }

    /// Whether it has a deck for stacks of spheres.
    pub fn stacks_spheres(&self) -> bool {
        self.definition().runs(TaskKind::Spheres)
    }

    /// Refuses a kind of task for which the code has no deck.
    pub(crate) fn check_task(&self, kind: TaskKind) -> Result<(), InvalidValue> {
        if self.definition().runs(kind) {
            return Ok(());
        }
        if self.is_rigid() {
            let accepted =
                format!("a code whose contacts have springs; the bodies of {self} are rigid");
            return Err(refused("code", self, accepted));
        }
        if kind == TaskKind::SideWalls {
            let accepted = format!("gravity-ramp for {self}");
            return Err(refused("protocol.preparation.kind", "side-walls", accepted));
        }
        let runs = |code: &Self| code.definition().runs(kind);
        let able = BUILT_IN_CODES.iter().filter(|code| runs(code));
        let able: Vec<&str> = able.map(Self::as_str).collect();
        let task = match kind {
            TaskKind::Stack => "a stack",
            TaskKind::Pyramid => "a pyramid",
            TaskKind::Spheres => "a stack of spheres",
            TaskKind::SpheresMotion => "a micro-test of spheres",
            TaskKind::Rigid => {
                let accepted =
                    format!("a code whose manifest has contact = \"rigid\"; {self} has springs");
                return Err(refused("code", self, accepted));
            }
            _ => "a micro-test",
        };
        let accepted = format!("one of {} for {task}", able.join(", "));
        Err(refused("code", self, accepted))
    }

    /// Refuses a code that compresses no stack of this many `bodies`, since its manifest has no task for it. For
    /// commands that do nothing else.
    ///
    /// # Errors
    /// Names the manifest and the table that it lacks.
    pub fn check_compresses(&self, bodies: u8) -> Result<(), ManifestError> {
        let definition = self.definition();
        let (kind, stack) = match bodies {
            PAPER_BODIES => (TaskKind::Stack, "stack"),
            _ => (TaskKind::Spheres, "stack of spheres"),
        };
        if definition.runs(kind) {
            return Ok(());
        }
        self.check_has_springs()?;
        let path = definition.place.path.clone();
        let message = format!(
            "`tasks.{}` is absent, so that {self} compresses no {stack}; accepted here is a table with the `files` of that \
             task (docs/your-own-code.md). `tristack probe`, `passport`, `impacts` and `check` need `tasks.motion` alone",
            kind.as_str()
        );
        Err(ManifestError::new(Place { path, line: None }, &message))
    }

    /// Refuses a code whose bodies are rigid. For commands that need springs.
    ///
    /// # Errors
    /// Names the manifest and its key.
    pub fn check_has_springs(&self) -> Result<(), ManifestError> {
        if !self.is_rigid() {
            return Ok(());
        }
        let path = self.definition().place.path.clone();
        let message = format!(
            "`contact` is \"rigid\"; accepted here is a code whose contacts have springs. `tristack check` and `crosscheck` \
             judge {self}"
        );
        Err(ManifestError::new(Place { path, line: None }, &message))
    }

    /// Refuses a code whose yield forces of stacks of this many `bodies` nothing can be compared with: neither rigid nor with a
    /// task for them.
    ///
    /// # Errors
    /// Names the manifest and the table that it lacks.
    pub fn check_yields(&self, bodies: u8) -> Result<(), ManifestError> {
        match self.definition().runs(TaskKind::Rigid) && bodies == PAPER_BODIES {
            true => Ok(()),
            false => self.check_compresses(bodies),
        }
    }

    /// Whether it can shorten runs.
    pub(crate) fn takes_shortcuts(&self) -> bool {
        self.is_native()
    }

    /// Refuses shortcuts, if they are `asked` for, where the code has none.
    pub fn check_shortcuts(&self, asked: bool) -> Result<(), InvalidValue> {
        if !asked || self.takes_shortcuts() {
            return Ok(());
        }
        let accepted = format!("none for {self}; native takes them");
        Err(refused("protocol.shortcuts", "given", accepted))
    }

    /// Hash of the files for a task of this kind, or of the sources of the native code.
    pub fn files_hash(&self, kind: TaskKind) -> String {
        match self.is_native() {
            true => crate::dem::SOURCE_DIGEST.to_owned(),
            false => self.definition().files_hash(kind),
        }
    }

    /// Approximate duration of a step of the stack in seconds, for forecasts of the time that is left.
    pub fn seconds_per_step(&self) -> f64 {
        self.definition().seconds.step
    }

    /// Approximate duration of a start in seconds.
    pub(crate) fn start_seconds(&self) -> f64 {
        self.definition().seconds.start
    }

    /// Time after which a run of `steps` steps counts as hanging.
    pub fn time_limit(&self, steps: u64) -> Duration {
        self.definition().time_limit(steps)
    }

    /// The folder that it was read from; `None` for the built-in codes.
    pub(crate) fn folder(&self) -> Option<&Path> {
        self.0.folder.as_deref()
    }

    /// Whether it runs an external program.
    pub fn has_program(&self) -> bool {
        self.definition().program.is_some()
    }

    /// Instructions for installing it; if there are none, where its program is looked for.
    pub fn installation_hint(&self) -> String {
        let definition = self.definition();
        if !definition.install.is_empty() {
            return definition.install.clone();
        }
        let program = definition.program.as_ref();
        let word = program.and_then(|program| program.command.first());
        let word = word.map_or("", String::as_str);
        format!("put its program `{word}` {}", self.places())
    }

    /// The file that would be its program if it were executable, for a code that is not found.
    pub fn not_executable(&self) -> Option<PathBuf> {
        let program = self.definition().program.as_ref()?;
        let directories = program.search.iter();
        let directories = directories.map(|place| place.get_ref().as_str());
        find_not_executable(directories, program.command.first()?)
    }

    /// Says why its program is not found, and what helps.
    pub fn absence(&self) -> String {
        match self.not_executable() {
            Some(file) => format!(
                "its program {} is there, but not executable; accepted is one that is: chmod +x {}",
                shown(&file),
                shell_quoted(&shown(&file))
            ),
            None => format!(
                "its program is not {}; install it with: {}",
                self.places(),
                self.installation_hint()
            ),
        }
    }

    /// Whether its program is here, in one of the places in which it is looked for. It is not started, and may be broken.
    pub fn is_here(&self) -> bool {
        let Some(program) = self.definition().program.as_ref() else {
            return self.is_native();
        };
        let mut places = program.search.iter().map(|place| place.get_ref().as_str());
        let word = program.command.first();
        word.is_some_and(|word| find_program(&mut places, word).is_some())
    }

    /// The places in which its program is looked for, in words.
    pub fn places(&self) -> String {
        let program = self.definition().program.iter();
        let directories = program.flat_map(|program| &program.search);
        let places = directories.map(|place| match place.get_ref().as_str() {
            SEARCH_PATH => "the search path",
            directory => directory,
        });
        let places: Vec<&str> = places.collect();
        match places.as_slice() {
            [] => "in the search path".to_owned(),
            places => format!("in {}", places.join(" or ")),
        }
    }
}

/// Returns the path of a folder, or FOLDER:NAME, as it is given to `--codes` in a shell: quoted where it must be, and
/// with a `/`, without which it would be the name of a code.
pub fn folder_argument(folder: &str) -> String {
    let folder = shown(Path::new(folder));
    match folder.contains('/') {
        true => shell_quoted(&folder),
        false => shell_quoted(&format!("./{folder}")),
    }
}

/// Returns the refusal of `definition`, whose name another code has.
fn taken(definition: &Definition) -> ManifestError {
    let message = format!(
        "`name` is {}; accepted is a name that no other code has",
        definition.name
    );
    ManifestError::new(definition.place.clone(), &message)
}

impl Code {
    /// Returns what distinguishes it from every other code, in the order of tables.
    fn key(&self) -> (usize, &str, Option<&Path>) {
        (self.0.place, self.as_str(), self.folder())
    }
}

impl PartialEq for Code {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for Code {}

impl PartialOrd for Code {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Code {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl Hash for Code {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

impl std::fmt::Debug for Code {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

impl Serialize for Code {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.as_str())
    }
}
