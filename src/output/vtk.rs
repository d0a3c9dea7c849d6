//! The stack as a time series for ParaView, in the XML format of VTK.

use crate::series::{ContactPoint, Frame, Frames, Partner};
use std::fmt::Write;

/// Most rows written, apart from the last one and the one of the largest force.
const MOST_ROWS: usize = 500;
const CYLINDERS: &str = "cylinders";
const CONTACTS: &str = "contacts";

/// A file of the series.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VtkFile {
    /// Name within the directory of the series.
    pub name: String,
    /// Content of the file.
    pub content: String,
}

/// The files of a series: `stack.pvd`, which lists the others with their times, and for every row
/// `cylinders_NNNN.vtp` (centres with angle, radius, and velocity where it is known) and
/// `contacts_NNNN.vtp` (contact points with the force on the cylinder; on a partner that is a cylinder its
/// opposite acts). Lengths in r, forces in m g, times in √(m/k_n), velocities in r √(k_n/m); `epsilon` is
/// m g in k_n r. Of long series every n-th row is kept, and always the last one and that of the largest force.
pub fn vtk_series(frames: &Frames, epsilon: f64) -> Vec<VtkFile> {
    let kept = kept_rows(frames);
    let mut files = Vec::with_capacity(2 * kept.len() + 1);
    let mut collection = format!(
        "<?xml version=\"1.0\"?>\n<!-- {} of {} rows. Lengths in r, forces in m g, times in sqrt(m/k_n). {} -->\n\
         <VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
        kept.len(),
        frames.frames.len(),
        if frames.pair_forces_known {
            "All contact forces."
        } else {
            "Forces of floor and wall; those between cylinders are not reported."
        }
    );
    for (number, &row) in kept.iter().enumerate() {
        let frame = &frames.frames[row];
        let parts = [
            (CYLINDERS, cylinders(frame, epsilon)),
            (CONTACTS, contacts(frame, epsilon)),
        ];
        for (part, (kind, content)) in parts.into_iter().enumerate() {
            let name = format!("{kind}_{number:04}.vtp");
            let time = frame.time;
            collection += &format!(
                "<DataSet timestep=\"{time}\" group=\"\" part=\"{part}\" name=\"{kind}\" file=\"{name}\"/>\n"
            );
            files.push(VtkFile { name, content });
        }
    }
    collection += "</Collection>\n</VTKFile>\n";
    files.push(VtkFile {
        name: "stack.pvd".to_owned(),
        content: collection,
    });
    files
}

/// Whether a file of this name is a row of such a series.
pub(crate) fn is_vtk_row(name: &str) -> bool {
    [CYLINDERS, CONTACTS].iter().any(|kind| {
        let number = name
            .strip_prefix(kind)
            .and_then(|rest| rest.strip_prefix('_'))
            .and_then(|rest| rest.strip_suffix(".vtp"));
        number.is_some_and(|digits| {
            digits.len() >= 4 && digits.bytes().all(|digit| digit.is_ascii_digit())
        })
    })
}

fn kept_rows(frames: &Frames) -> Vec<usize> {
    let all = &frames.frames;
    let every = all.len().div_ceil(MOST_ROWS).max(1);
    let force = |index: usize| all[index].wall_force;
    let highest = (0..all.len()).max_by(|&i, &j| force(i).total_cmp(&force(j)));
    (0..all.len())
        .filter(|&row| row % every == 0 || row + 1 == all.len() || Some(row) == highest)
        .collect()
}

fn cylinders(frame: &Frame, epsilon: f64) -> String {
    let bodies = &frame.cylinders;
    let mut data = PointData::new(bodies.iter().map(|body| body.position));
    data.integers("cylinder", (1..=bodies.len()).map(|number| number as i64));
    data.numbers("radius", bodies.iter().map(|_| 1.0));
    data.numbers("angle", bodies.iter().map(|body| body.angle));
    let velocities: Option<Vec<[f64; 2]>> = bodies.iter().map(|body| body.velocity).collect();
    if let Some(velocities) = velocities {
        data.vectors("velocity", velocities.into_iter());
    }
    data.finish(&[
        ("TimeValue", frame.time),
        ("wall_height", frame.wall_height),
        ("wall_force", frame.wall_force / epsilon),
    ])
}

fn contacts(frame: &Frame, epsilon: f64) -> String {
    let contacts = &frame.contacts;
    let mut data = PointData::new(contacts.iter().map(|contact| contact.position));
    let numbers = contacts.iter().map(|contact| contact.cylinder as i64 + 1);
    data.integers("cylinder", numbers);
    // Floor 0, top wall −1: cylinders count from 1.
    let partners = contacts.iter().map(|contact| match contact.partner {
        Partner::Cylinder(index) => index as i64 + 1,
        Partner::Floor => 0,
        Partner::TopWall => -1,
    });
    data.integers("partner", partners);
    let weights = |force: fn(&ContactPoint) -> f64| {
        let forces = contacts.iter().map(force);
        forces.map(|force| force / epsilon)
    };
    let vectors = contacts.iter().map(ContactPoint::force);
    data.vectors(
        "force",
        vectors.map(|force| force.map(|part| part / epsilon)),
    );
    data.numbers("normal_force", weights(|contact| contact.normal_force));
    data.numbers(
        "tangential_force",
        weights(|contact| contact.tangential_force),
    );
    data.finish(&[("TimeValue", frame.time)])
}

/// Points, each a vertex, and their data.
struct PointData {
    count: usize,
    points: String,
    arrays: String,
}

impl PointData {
    fn new(points: impl ExactSizeIterator<Item = [f64; 2]>) -> Self {
        Self {
            count: points.len(),
            points: components(points),
            arrays: String::new(),
        }
    }

    fn numbers(&mut self, name: &str, values: impl Iterator<Item = f64>) {
        self.array("Float64", name, 1, &joined(values));
    }

    fn integers(&mut self, name: &str, values: impl Iterator<Item = i64>) {
        self.array("Int64", name, 1, &joined(values));
    }

    fn vectors(&mut self, name: &str, values: impl Iterator<Item = [f64; 2]>) {
        self.array("Float64", name, 3, &components(values));
    }

    fn array(&mut self, kind: &str, name: &str, components: usize, values: &str) {
        writeln!(
            self.arrays,
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">{values}</DataArray>"
        )
        .expect("text is written to memory");
    }

    /// The document, with numbers for the whole frame.
    fn finish(self, of_the_frame: &[(&str, f64)]) -> String {
        let count = self.count;
        let fields: String = of_the_frame
            .iter()
            .map(|(name, value)| {
                format!(
                    "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfTuples=\"1\" format=\"ascii\">{value}</DataArray>\n"
                )
            })
            .collect();
        format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n\
             <FieldData>\n{fields}</FieldData>\n\
             <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n\
             <PointData>\n{arrays}</PointData>\n\
             <Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">{points}</DataArray>\n</Points>\n\
             <Verts>\n\
             <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">{connectivity}</DataArray>\n\
             <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{offsets}</DataArray>\n\
             </Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n",
            arrays = self.arrays,
            points = self.points,
            connectivity = joined(0..count),
            offsets = joined(1..=count),
        )
    }
}

/// Vectors of the plane in three dimensions.
fn components(vectors: impl Iterator<Item = [f64; 2]>) -> String {
    joined(vectors.map(|[x, y]| format!("{x} {y} 0")))
}

fn joined(values: impl Iterator<Item = impl ToString>) -> String {
    let values: Vec<String> = values.map(|value| value.to_string()).collect();
    values.join(" ")
}
