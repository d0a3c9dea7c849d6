//! The stack as a time series for ParaView, in the XML format of VTK.

use crate::model::{PAPER_BODIES, Stack};
use crate::series::{ContactPoint, Frame, Frames, Partner};

/// Maximum number of rows written, apart from the last one and that of the largest force.
const MOST_ROWS: usize = 500;
/// Name of the file that lists the others.
pub const VTK_COLLECTION: &str = "stack.pvd";
const UNITS: &str = "Lengths in r, forces in m g, times in sqrt(m/k_n).";
/// Kinds of files, apart from the collection.
const KINDS: [&str; 3] = ["cylinders", "spheres", CONTACTS];
const CONTACTS: &str = "contacts";

/// A file of the series.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VtkFile {
    /// Name within the directory of the series.
    pub name: String,
    /// Content of the file.
    pub content: String,
}

/// Returns the files of a series of `stack`: `stack.pvd`, which lists the others with their times, and for every row
/// `cylinders_NNNN.vtp` (centres with angle, radius, and velocity where it is known) or `spheres_NNNN.vtp` (with the
/// rotation as a vector), and `contacts_NNNN.vtp` (contact points with the force on the body; the opposite force acts
/// on its partner, if that is a body). Lengths are in r, forces in m g, times in √(m/k_n), velocities in r √(k_n/m).
/// Long series are thinned to every n-th row, but always keep the last one and that of the largest force.
pub fn vtk_series(frames: &Frames, stack: &Stack) -> Vec<VtkFile> {
    let kept = kept_rows(frames);
    let mut files = Vec::with_capacity(2 * kept.len() + 1);
    let mut collection = format!(
        "<?xml version=\"1.0\"?>\n<!-- {} of {} rows. {UNITS} {} -->\n\
         <VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
        kept.len(),
        frames.frames.len(),
        if frames.pair_forces_known {
            "All contact forces.".to_owned()
        } else {
            let kind = stack.kind();
            format!("Forces of floor and wall; those between {kind} are not reported.")
        }
    );
    for (number, &row) in kept.iter().enumerate() {
        let frame = &frames.frames[row];
        let parts = [
            (stack.kind(), bodies(frame, stack)),
            (CONTACTS, contacts(frame, stack)),
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
        name: VTK_COLLECTION.to_owned(),
        content: collection,
    });
    files
}

/// Whether this program wrote a collection with this content.
pub fn is_vtk_collection(content: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&content[..content.len().min(200)]);
    start.contains(UNITS)
}

/// Whether a file of this name is a row of such a series.
pub fn is_vtk_row(name: &str) -> bool {
    let parts = name.strip_suffix(".vtp");
    let parts = parts.and_then(|name| name.split_once('_'));
    parts.is_some_and(|(kind, number)| {
        let digits = number.bytes().all(|digit| digit.is_ascii_digit());
        KINDS.contains(&kind) && number.len() >= 4 && digits
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

/// Returns the name of the column that numbers the bodies.
fn number_of(stack: &Stack) -> &'static str {
    match stack.bodies {
        PAPER_BODIES => "cylinder",
        _ => "sphere",
    }
}

fn bodies(frame: &Frame, stack: &Stack) -> String {
    let bodies = &frame.bodies;
    let mut arrays = vec![
        integers(number_of(stack), 1..=bodies.len() as i64),
        numbers("radius", bodies.iter().map(|_| 1.0)),
        match stack.bodies {
            PAPER_BODIES => numbers("angle", bodies.iter().map(|body| body.rotation[2])),
            _ => vectors("rotation", bodies.iter().map(|body| body.rotation)),
        },
    ];
    let velocities: Option<Vec<[f64; 3]>> = bodies.iter().map(|body| body.velocity).collect();
    arrays.extend(velocities.map(|velocities| vectors("velocity", velocities)));
    let of_the_frame = [
        ("TimeValue", frame.time),
        ("wall_height", frame.wall_height),
        ("wall_force", frame.wall_force / stack.epsilon()),
    ];
    let positions = bodies.iter().map(|body| body.position);
    document(&of_the_frame, positions.collect(), &arrays)
}

fn contacts(frame: &Frame, stack: &Stack) -> String {
    let epsilon = stack.epsilon();
    let all = || frame.contacts.iter();
    // Bodies count from 1; the floor is 0, the top wall −1.
    let partner = |contact: &ContactPoint| match contact.partner {
        Partner::Body(index) => index as i64 + 1,
        Partner::Floor => 0,
        Partner::TopWall => -1,
    };
    let force = |contact: &ContactPoint| contact.force().map(|part| part / epsilon);
    let arrays = [
        integers(number_of(stack), all().map(|own| own.body as i64 + 1)),
        integers("partner", all().map(partner)),
        vectors("force", all().map(force)),
        numbers("normal_force", all().map(|own| own.normal_force / epsilon)),
        numbers(
            "tangential_force",
            all().map(|own| own.tangential_force / epsilon),
        ),
    ];
    let positions = all().map(|contact| contact.position);
    document(&[("TimeValue", frame.time)], positions.collect(), &arrays)
}

fn numbers(name: &str, values: impl IntoIterator<Item = f64>) -> String {
    array("Float64", name, 1, &joined(values))
}

fn integers(name: &str, values: impl IntoIterator<Item = i64>) -> String {
    array("Int64", name, 1, &joined(values))
}

fn vectors(name: &str, values: impl IntoIterator<Item = [f64; 3]>) -> String {
    // Adding zero removes the negative zeros that products with the plane's z = 0 may give.
    let components = values
        .into_iter()
        .map(|[x, y, z]| format!("{x} {y} {}", z + 0.0));
    array("Float64", name, 3, &joined(components))
}

fn array(kind: &str, name: &str, components: usize, values: &str) -> String {
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"ascii\">{values}</DataArray>\n"
    )
}

/// Formats points, each a vertex, with their data, and numbers for the whole frame.
fn document(of_the_frame: &[(&str, f64)], points: Vec<[f64; 3]>, arrays: &[String]) -> String {
    let count = points.len();
    let fields = of_the_frame.iter().map(|(name, value)| {
        format!(
            "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfTuples=\"1\" format=\"ascii\">\
             {value}</DataArray>\n"
        )
    });
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n\
         <FieldData>\n{fields}</FieldData>\n\
         <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"0\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n\
         <PointData>\n{arrays}</PointData>\n\
         <Points>\n{points}</Points>\n\
         <Verts>\n\
         <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">{connectivity}</DataArray>\n\
         <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{offsets}</DataArray>\n\
         </Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n",
        fields = fields.collect::<String>(),
        arrays = arrays.concat(),
        points = vectors("Points", points),
        connectivity = joined(0..count),
        offsets = joined(1..=count),
    )
}

fn joined(values: impl IntoIterator<Item = impl ToString>) -> String {
    let values = values.into_iter().map(|value| value.to_string());
    values.collect::<Vec<_>>().join(" ")
}
