//! The study file as written, every name with its place.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

pub use super::kind::Kind;
use tables::units::Amount;

/// Names with what is said of them, in the order of the alphabet.
pub(super) type Table<T> = BTreeMap<Spanned<String>, Spanned<T>>;

/// A study file.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// The file as it was read.
    #[serde(skip)]
    pub(super) text: String,
    /// Path of the chain, relative to the study.
    pub chain: Spanned<String>,
    /// The observable that was measured; the chain's only one if not given.
    pub observable: Option<Spanned<String>>,
    /// Paths of the data files, relative to the study.
    pub data: Spanned<OneOrMore>,
    /// Where the data are to be had, for whoever has not got them.
    pub data_from: Option<String>,
    /// The column of the data files that names their rows.
    pub id: Option<String>,
    /// The separator of the data files, where it cannot be seen from their header.
    pub separator: Option<Spanned<char>>,
    /// What lines of the data files that are comments begin with, where there are any below the header.
    pub comment: Option<Spanned<char>>,
    /// How much memory the rows may take: `8 GiB`.
    pub memory: Option<Spanned<String>>,
    /// Where the instrument stands, for files that give a time and no place.
    pub(super) site: Option<Site>,
    /// What says where a vehicle was at the time of each row.
    pub(super) trajectory: Option<TrajectoryTable>,
    /// Which column is which joint or input.
    #[serde(default)]
    pub(super) columns: Table<Column>,
    /// What was measured.
    pub(super) observed: Spanned<Observed>,
    /// What is known of the noise.
    #[serde(default)]
    pub(super) noise: NoiseTable,
    /// What to estimate.
    #[serde(default)]
    pub(super) fit: FitTable,
    /// What to look for.
    #[serde(default)]
    pub(super) search: SearchTable,
    /// Which model to fit, where it is not to be looked for.
    #[serde(default)]
    pub(super) model: ModelTable,
    /// How uncertain the reference is.
    pub(super) reference: Option<Spanned<ReferenceTable>>,
    /// Effects that the catalogue does not have.
    #[serde(default)]
    pub(super) effect: Vec<OwnEffect>,
    /// How to judge on data that no stage saw.
    #[serde(default)]
    pub(super) hold_out: HoldOutTable,
    /// Where to propose to measure next.
    pub(super) next: Option<Spanned<NextTable>>,
    /// How good the instrument is to be.
    #[serde(default)]
    pub(super) goal: GoalTable,
    /// How the answer is told.
    #[serde(default)]
    pub(super) report: ReportTable,
    /// Further data that observe otherwise.
    #[serde(default)]
    pub(super) also: Vec<Also>,
    /// Where stations stood, as far as that is known.
    #[serde(default)]
    pub(super) stations: Table<StationTable>,
    /// Where objects are, as far as that is known.
    #[serde(default)]
    pub(super) objects: Table<ObjectTable>,
}

/// `[stations]`: a pose, known exactly, with standard uncertainties, or roughly as a start; or that it was levelled.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct StationTable {
    pub x: Option<Amount>,
    pub y: Option<Amount>,
    pub z: Option<Amount>,
    pub roll: Option<Amount>,
    pub pitch: Option<Amount>,
    pub heading: Option<Amount>,
    pub rough: bool,
    pub sigma: Option<Amount>,
    pub sigma_angle: Option<Amount>,
    pub levelled: Option<Amount>,
}

/// `[objects]`: the coordinates of a target, known exactly, with a standard uncertainty, or roughly as a start.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectTable {
    pub x: Amount,
    pub y: Amount,
    pub z: Amount,
    #[serde(default)]
    pub rough: bool,
    pub sigma: Option<Amount>,
}

/// Data that observe something else, or in another way, than the study's first.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Also {
    pub observable: Option<Spanned<String>>,
    pub data: Spanned<OneOrMore>,
    #[serde(default)]
    pub columns: Table<Column>,
    pub observed: Spanned<Observed>,
    pub sigma: Option<Spanned<Sigma>>,
}

/// `[[effect]]`: one of the user's own.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OwnEffect {
    pub name: Spanned<String>,
    pub body: Spanned<String>,
    pub part: Option<Spanned<String>>,
    pub moves: Spanned<String>,
    pub functions: Spanned<Vec<Spanned<String>>>,
}

/// One text or a list of them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct OneOrMore(pub Vec<String>);

/// Where the readings of a joint or input are.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, remote = "Self")]
pub(super) struct Column {
    pub column: Option<String>,
    pub unit: Option<String>,
    pub derive: Option<String>,
    /// What the input is: `temperature`, `direction of beta`.
    pub meaning: Option<Spanned<String>>,
    /// How uncertain a reading is.
    pub sigma: Option<Spanned<Sigma>>,
    /// 1, or -1 where it counts the other way.
    pub sign: Option<Spanned<i64>>,
    /// What is added to each number.
    pub offset: Option<Spanned<Amount>>,
    /// The numbers are counts of an encoder: how many a turn has.
    pub counts_per_turn: Option<Spanned<f64>>,
    /// `ddd.mmss` or `hhmmss`.
    pub notation: Option<Spanned<String>>,
    /// A row takes the reading of the row that stands so many before it.
    pub shift: Option<Spanned<i64>>,
    /// How its error hangs together with that of other readings of the row.
    #[serde(default)]
    pub correlation: Table<Correlation>,
}

/// A correlation of two readings: of every row, or the name of the column that says it.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Correlation {
    Evenly(f64),
    Column(String),
}

/// `[observed]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Observed {
    pub kind: Kind,
    pub x: Option<Column>,
    pub y: Option<Column>,
    pub z: Option<Column>,
    pub azimuth: Option<Column>,
    pub elevation: Option<Column>,
    pub ha: Option<Column>,
    pub dec: Option<Column>,
    pub cross: Option<Column>,
    pub along: Option<Column>,
    pub range: Option<Column>,
    /// The columns that name what was observed.
    #[serde(default)]
    pub object: OneOrMore,
    /// The columns that name where from.
    #[serde(default)]
    pub station: OneOrMore,
    pub u: Option<Column>,
    pub v: Option<Column>,
    pub length: Option<Column>,
    pub radius: Option<Column>,
    pub rotation_x: Option<Column>,
    pub rotation_y: Option<Column>,
    pub rotation_z: Option<Column>,
    pub w: Option<Column>,
    pub rx: Option<Column>,
    pub ry: Option<Column>,
    pub rz: Option<Column>,
    pub r11: Option<Column>,
    pub r12: Option<Column>,
    pub r13: Option<Column>,
    pub r21: Option<Column>,
    pub r22: Option<Column>,
    pub r23: Option<Column>,
    pub r31: Option<Column>,
    pub r32: Option<Column>,
    pub r33: Option<Column>,
    /// About which axes three angles turn, one after another: `zyx`.
    pub euler: Option<Spanned<String>>,
    pub e1: Option<Column>,
    pub e2: Option<Column>,
    pub e3: Option<Column>,
}

impl Observed {
    /// Whether a column is named by a key.
    pub(super) fn names(&self, key: &str) -> bool {
        self.columns().iter().any(|(own, column)| *own == key && column.is_some())
    }

    /// Every column by its key.
    pub(super) fn columns(&self) -> [(&'static str, &Option<Column>); 33] {
        [
            ("x", &self.x),
            ("y", &self.y),
            ("z", &self.z),
            ("azimuth", &self.azimuth),
            ("elevation", &self.elevation),
            ("ha", &self.ha),
            ("dec", &self.dec),
            ("cross", &self.cross),
            ("along", &self.along),
            ("range", &self.range),
            ("u", &self.u),
            ("v", &self.v),
            ("length", &self.length),
            ("radius", &self.radius),
            ("rotation_x", &self.rotation_x),
            ("rotation_y", &self.rotation_y),
            ("rotation_z", &self.rotation_z),
            ("w", &self.w),
            ("rx", &self.rx),
            ("ry", &self.ry),
            ("rz", &self.rz),
            ("r11", &self.r11),
            ("r12", &self.r12),
            ("r13", &self.r13),
            ("r21", &self.r21),
            ("r22", &self.r22),
            ("r23", &self.r23),
            ("r31", &self.r31),
            ("r32", &self.r32),
            ("r33", &self.r33),
            ("e1", &self.e1),
            ("e2", &self.e2),
            ("e3", &self.e3),
        ]
    }
}

/// `[noise]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct NoiseTable {
    pub sigma: Option<Spanned<Sigma>>,
    pub group: OneOrMore,
    pub order: Option<String>,
    pub variance: bool,
    pub serial: bool,
}

impl Default for NoiseTable {
    fn default() -> Self {
        Self { sigma: None, group: OneOrMore::default(), order: None, variance: true, serial: true }
    }
}

/// The standard deviation: one for all, or a column, or a column for each component.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Sigma {
    Amount(Amount),
    Columns(Vec<Column>),
}

/// `[fit]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct FitTable {
    pub estimate: Vec<Spanned<String>>,
    pub fix: Table<Amount>,
    pub start: Table<Amount>,
    pub robust: bool,
    pub max_iterations: Spanned<u64>,
    /// How large errors may be that the data do not show.
    pub tolerance: Table<Amount>,
    /// How large errors may be: a larger value is no finding.
    pub plausible: Table<Amount>,
}

impl Default for FitTable {
    fn default() -> Self {
        let all = Spanned::new(0..0, "*".to_string());
        Self {
            estimate: vec![all],
            fix: Table::new(),
            start: Table::new(),
            robust: true,
            max_iterations: Spanned::new(0..0, 50),
            tolerance: Table::new(),
            plausible: Table::new(),
        }
    }
}

/// `[search]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct SearchTable {
    pub false_alarm: Spanned<f64>,
    pub most: Spanned<u64>,
    pub functions: Option<bool>,
    pub inputs: Vec<Spanned<String>>,
    pub sequence: bool,
    pub harmonics: Spanned<u64>,
    pub effects: Vec<Spanned<String>>,
    pub lines: Table<u64>,
}

impl Default for SearchTable {
    fn default() -> Self {
        Self {
            false_alarm: Spanned::new(0..0, 0.05),
            most: Spanned::new(0..0, 20),
            functions: None,
            inputs: Vec::new(),
            sequence: false,
            harmonics: Spanned::new(0..0, 8),
            effects: Vec::new(),
            lines: Table::new(),
        }
    }
}

/// `[model]`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ModelTable {
    /// Exactly these are fitted.
    pub terms: Option<Spanned<Vec<Spanned<String>>>>,
}

/// `[reference]`: standard uncertainties of what rows are compared with.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ReferenceTable {
    pub scale: Option<Spanned<Amount>>,
    pub targets: Option<Spanned<Amount>>,
    /// The columns that name targets; else rows with the same coordinates have one.
    pub target: Option<Spanned<OneOrMore>>,
    pub rotation: Option<Spanned<Amount>>,
    pub shift: Option<Spanned<Amount>>,
}

/// `[hold_out]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct HoldOutTable {
    pub folds: Spanned<u64>,
    pub file: Option<String>,
    pub together: OneOrMore,
    pub seed: u64,
}

impl Default for HoldOutTable {
    fn default() -> Self {
        Self { folds: Spanned::new(0..0, 10), file: None, together: OneOrMore::default(), seed: 1 }
    }
}

/// `[goal]`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalTable {
    /// The largest RMS on held-out rows that is good enough.
    pub rms: Option<Spanned<Amount>>,
}

/// `[report]`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ReportTable {
    /// The errors that stand first: names and patterns.
    pub wanted: Vec<Spanned<String>>,
}

/// `[next]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NextTable {
    pub poses: Option<Spanned<u64>>,
    #[serde(default)]
    pub range: Table<[Amount; 2]>,
    /// How many places to stand.
    pub stations: Option<Spanned<u64>>,
    /// How many objects of each kind.
    #[serde(default)]
    pub objects: Table<u64>,
    /// Between which coordinates.
    #[serde(default)]
    pub place: Table<[Amount; 2]>,
}

/// A place on the Earth: angles with their units, north and east positive.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Site {
    pub latitude: Spanned<String>,
    pub longitude: Spanned<String>,
}

/// `[trajectory]`: poses that join the rows by time.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TrajectoryTable {
    pub file: Spanned<String>,
    pub time: String,
    pub offset: Option<Spanned<String>>,
    pub gap: Option<Spanned<String>>,
    pub origin: Option<Origin>,
}

/// A place on the Earth with its height above the ellipsoid.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Origin {
    pub latitude: Spanned<String>,
    pub longitude: Spanned<String>,
    pub height: Spanned<Amount>,
}
