//! The faults.

use super::disk;
use std::path::Path;

/// A thing that goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    Process(ProcessFault),
    Code(CodeFault),
    Store(StoreFault),
    Disk(DiskFault),
    Folder(FolderFault),
}

/// A fault of a running tristack or of the processes it has started, at a random moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ProcessFault {
    Killed,
    KilledTwice,
    KilledWhileCodeHangs,
    Interrupted,
    InterruptedTwice,
    Terminated,
    StoppedForAWhile,
    CodeKilled,
    CodeStopped,
    GuardKilled,
    CodeReplaced,
    HiddenCodeReplaced,
    ClockJumps,
    TwoAtOnce,
    TwoAtOnceOneKilled,
}

/// A fault of a code in place of one of its series.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CodeFault {
    Crashes,
    IsKilledForItsMemory,
    TakesTooMuchMemory,
    Hangs,
    StopsItself,
    EndsSilently,
    EndsWithAnError,
    LeavesADaemon,
    WritesTenGigabytes,
    FillsAFile,
    LeavesANamedPipe,
    LeavesALinkToADevice,
    SeriesTruncated,
    SeriesCutInARow,
    SeriesReordered,
    SeriesDuplicated,
    SeriesNotANumber,
    SeriesInOtherUnits,
    SeriesOfAnotherCase,
    SeriesWithoutAColumn,
    SeriesNotText,
    SeriesEmpty,
    SeriesWithoutRows,
}

/// A defect of the store that the next program finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum StoreFault {
    BitFlipped,
    FileTruncated,
    FileMissing,
    MadeWithAnotherDeck,
    MadeByAnotherProgram,
    OtherFormat,
    NamedPipeInPlace,
    LinkInPlace,
    ForeignFiles,
}

/// A fault of the file system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum DiskFault {
    Full,
    ReadOnly,
    RunsReadOnly,
}

/// What a folder does that somebody else has written, at a random command and a random question.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FolderFault {
    Hangs,
    WritesOutside,
    FloodsOutput,
    FloodsFiles,
    FloodsMemory,
    LeavesChildren,
    LiesAboutItsVersion,
}

impl Fault {
    /// Every fault, the kinds taking turns.
    pub fn all() -> impl Iterator<Item = Self> {
        use {
            CodeFault as E, DiskFault as D, FolderFault as F, ProcessFault as P, StoreFault as S,
        };
        let process = [
            P::Killed,
            P::Interrupted,
            P::CodeKilled,
            P::TwoAtOnce,
            P::KilledTwice,
            P::KilledWhileCodeHangs,
            P::Terminated,
            P::StoppedForAWhile,
            P::GuardKilled,
            P::InterruptedTwice,
            P::CodeStopped,
            P::CodeReplaced,
            P::HiddenCodeReplaced,
            P::TwoAtOnceOneKilled,
            P::ClockJumps,
        ];
        let code = [
            E::Crashes,
            E::IsKilledForItsMemory,
            E::TakesTooMuchMemory,
            E::Hangs,
            E::StopsItself,
            E::EndsSilently,
            E::EndsWithAnError,
            E::LeavesADaemon,
            E::WritesTenGigabytes,
            E::FillsAFile,
            E::LeavesANamedPipe,
            E::LeavesALinkToADevice,
            E::SeriesTruncated,
            E::SeriesCutInARow,
            E::SeriesReordered,
            E::SeriesDuplicated,
            E::SeriesNotANumber,
            E::SeriesInOtherUnits,
            E::SeriesOfAnotherCase,
            E::SeriesWithoutAColumn,
            E::SeriesNotText,
            E::SeriesEmpty,
            E::SeriesWithoutRows,
        ];
        let store = [
            S::BitFlipped,
            S::FileTruncated,
            S::FileMissing,
            S::MadeWithAnotherDeck,
            S::MadeByAnotherProgram,
            S::OtherFormat,
            S::NamedPipeInPlace,
            S::LinkInPlace,
            S::ForeignFiles,
        ];
        let disk = [D::Full, D::ReadOnly, D::RunsReadOnly];
        let folder = [
            F::Hangs,
            F::WritesOutside,
            F::FloodsOutput,
            F::FloodsFiles,
            F::FloodsMemory,
            F::LeavesChildren,
            F::LiesAboutItsVersion,
        ];
        let process = process.into_iter().map(Self::Process);
        let code = code.into_iter().map(Self::Code);
        let store = store.into_iter().map(Self::Store);
        process
            .chain(code)
            .chain(store)
            .chain(disk.into_iter().map(Self::Disk))
            .chain(folder.into_iter().map(Self::Folder))
    }

    /// Whether this machine can do it; otherwise it is said, and left out.
    pub fn is_possible(&self) -> bool {
        let missing = match self {
            Self::Disk(_) if !disk::can_mount() => "no file system can be mounted",
            Self::Process(ProcessFault::ClockJumps) if fake_clock().is_none() => {
                "libfaketime is not installed"
            }
            _ => return true,
        };
        eprintln!("{self:?} is left out: {missing}");
        let required = std::env::var_os("TRISTACK_REQUIRE_FAULTS").is_some();
        assert!(!required, "{self:?} is required");
        false
    }
}

/// A library that makes a program believe in another time.
pub fn fake_clock() -> Option<&'static Path> {
    let path = Path::new("/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1");
    path.exists().then_some(path)
}
