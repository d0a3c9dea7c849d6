//! Pictures of a run: the stack with its contact forces, and files for ParaView.

use super::out::{Out, write};
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::{Code, Failure, FailureKind, Run};
use crate::dem::compress_stack_into_frames;
use crate::files::{FileError, Layout, remove_older};
use crate::model::{InvalidValue, shown};
use crate::output::{VTK_COLLECTION, is_vtk_collection, is_vtk_row, run_pdf, run_svg, vtk_series};
use crate::series::Frames;
use clap::Args;
use std::path::{Path, PathBuf};

/// The pictures of one run.
#[derive(Debug, Args)]
pub(super) struct Pictures {
    /// Picture of the stack with its contact forces, at rest, at yield and in collapse: SVG, or PDF if FILE ends in .pdf
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Directory for a time series that ParaView opens (stack.pvd): bodies and contact forces, at most some 500 rows
    #[arg(long, value_name = "DIR")]
    vtk: Option<PathBuf>,
}

impl Pictures {
    /// Refuses a picture in a format that is not written, before anything runs, and claims the directory for ParaView
    /// unless it is that of the results, `out`.
    pub(super) fn claim(&self, out: Option<&Path>) -> Result<(), CliError> {
        if let Some(file) = &self.svg {
            Format::of(file)?;
        }
        let vtk = self.vtk.as_deref();
        let outside =
            vtk.filter(|&vtk| inside(out, Some(vtk)).is_none_or(|inside| !inside.is_empty()));
        Out::claim(outside, &vtk_layout())?;
        Ok(())
    }

    /// Returns the first flag that asks for a picture, and its value.
    pub(super) fn named(&self) -> Option<(&'static str, &Path)> {
        let all = [("--svg", &self.svg), ("--vtk", &self.vtk)];
        let mut named = all.into_iter();
        named.find_map(|(flag, path)| Some((flag, path.as_deref()?)))
    }

    /// Returns the files of the requested pictures that lie in the directory of the results, `out`.
    pub(super) fn files_in(&self, out: Option<&Path>) -> Vec<String> {
        let mut files: Vec<String> = inside(out, self.svg.as_deref()).into_iter().collect();
        if let Some(vtk) = inside(out, self.vtk.as_deref()) {
            let names = vtk_layout().files.into_iter();
            let names = names.chain([VTK_COLLECTION.to_owned()]);
            files.extend(names.map(|name| match vtk.as_str() {
                "" => name,
                folder => format!("{folder}/{name}"),
            }));
        }
        files
    }

    /// Writes the requested pictures of a run by `code`.
    pub(super) fn draw(&self, code: &Code, run: &Run) -> Result<ExitStatus, CliError> {
        let mut status = ExitStatus::Success;
        if self.svg.is_none() && self.vtk.is_none() {
            return Ok(status);
        }
        let frames = frames(code, run)?;
        if let Some(file) = &self.svg {
            let name = &run.provenance.identity.code;
            status = write(file, &Format::of(file)?.picture(name, run, &frames));
        }
        if let Some(directory) = &self.vtk {
            remove_vtk_rows(directory)?;
            let files = vtk_series(&frames, &run.case.stack).into_iter();
            let files = || files.map(|file| (file.name, file.content)).collect();
            let written = Out::claimed(directory, VTK_COLLECTION).write(files);
            status = status.max(written);
        }
        Ok(status)
    }
}

/// The format of the picture of a stack.
#[derive(Debug, Clone, Copy)]
enum Format {
    Svg,
    Pdf,
}

impl Format {
    /// Returns the format that the name of `file` says.
    fn of(file: &Path) -> Result<Self, InvalidValue> {
        let ending = file.extension().map(|ending| ending.to_ascii_lowercase());
        match ending.as_ref().and_then(|ending| ending.to_str()) {
            Some("svg") => Ok(Self::Svg),
            Some("pdf") => Ok(Self::Pdf),
            _ => Err(InvalidValue {
                key: "--svg".to_owned(),
                value: shown(file),
                accepted: "a file whose name ends in .svg or .pdf".to_owned(),
            }),
        }
    }

    fn picture(self, code: &str, run: &Run, frames: &Frames) -> Vec<u8> {
        match self {
            Self::Svg => run_svg(code, &run.case, frames).into_bytes(),
            Self::Pdf => run_pdf(code, &run.case, frames),
        }
    }
}

/// Returns the path of `place` within the directory `out`, if it lies there.
fn inside(out: Option<&Path>, place: Option<&Path>) -> Option<String> {
    let [out, place] = [out?, place?].map(|path| std::path::absolute(path).ok());
    let inside = place?.strip_prefix(out?).ok()?.to_str()?.to_owned();
    Some(inside)
}

/// Returns the files for ParaView.
fn vtk_layout() -> Layout {
    Layout {
        witness: VTK_COLLECTION,
        is_ours: is_vtk_collection,
        files: ["cylinders_*.vtp", "spheres_*.vtp", "contacts_*.vtp"]
            .map(str::to_owned)
            .to_vec(),
        shared: false,
        scratch: None,
    }
}

/// Removes the rows of an earlier series, which may have been longer.
fn remove_vtk_rows(directory: &Path) -> Result<(), FileError> {
    let entries = std::fs::read_dir(directory).map_err(FileError::writing(directory))?;
    for entry in entries.flatten() {
        if is_vtk_row(&entry.file_name().to_string_lossy()) {
            let path = entry.path();
            remove_older(&path).map_err(FileError::writing(&path))?;
        }
    }
    Ok(())
}

/// Returns every sampled moment of the run. The native DEM runs again, with bitwise the same result, because its
/// series leaves out the forces between the cylinders.
fn frames(code: &Code, run: &Run) -> Result<Frames, CliError> {
    if !code.is_native() {
        return Ok(Frames::of_series(&run.series, &run.case)?);
    }
    let repeated = compress_stack_into_frames(&run.case, || !INTERRUPT.requested());
    let (_, frames) = repeated.map_err(|error| {
        let kind = match INTERRUPT.requested() {
            true => FailureKind::Interrupted,
            false => error.into(),
        };
        Box::new(Failure::new(code.clone(), &run.case, kind))
    })?;
    Ok(frames)
}
