//! The one table of numbers that decide: name, value, meaning, source. No other file of this crate holds one.

/// One line of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threshold {
    /// The name of the field of [`Policy`].
    pub name: &'static str,
    /// The value.
    pub value: f64,
    /// What the value decides, with its unit.
    pub meaning: &'static str,
    /// The paper or the simulation that the value comes from.
    pub source: &'static str,
}

impl Threshold {
    /// A line.
    #[must_use]
    pub const fn new(name: &'static str, value: f64, meaning: &'static str, source: &'static str) -> Self {
        Self { name, value, meaning, source }
    }
}

/// Writes the struct, its defaults and the table from one list, so that they cannot differ.
macro_rules! policy {
    ($($(#[doc = $meaning:literal])+ $name:ident = $value:literal, $source:literal;)*) => {
        /// Every number that decides in a contest.
        #[derive(Debug, Clone, PartialEq)]
        pub struct Policy { $($(#[doc = $meaning])+ pub $name: f64,)* }

        impl Default for Policy {
            fn default() -> Self {
                Self { $($name: $value,)* }
            }
        }

        impl Policy {
            /// What a harmonic pays for its order, nats.
            #[must_use]
            pub fn of_order(&self, order: usize) -> f64 {
                let power = if order < 3 { self.harmonic_low } else { self.harmonic_high };
                power * (order as f64).ln()
            }

            /// The table, in the order of the list.
            #[must_use]
            pub fn table(&self) -> Vec<Threshold> {
                vec![$(Threshold {
                    name: stringify!($name),
                    value: self.$name,
                    meaning: concat!($($meaning),+).trim_ascii(),
                    source: $source,
                },)*]
            }

            /// Sets one value by its name, for measuring what halving or doubling does. False where no value has this name.
            pub fn set(&mut self, name: &str, value: f64) -> bool {
                match name {
                    $(stringify!($name) => self.$name = value,)*
                    _ => return false,
                }
                true
            }
        }
    };
}

policy! {
    /// Singular value of the scaled declared columns, over the largest, below which a combination is not estimable.
    rank = 1e-6, "numerics: first-order columns by differences hold six digits";
    /// Distance of two places' columns, over their length, below which they are one place.
    same_place = 1e-5, "first-order columns by differences hold six digits; visible only above 1e5 standard deviations";
    /// Energy of a family behind the declared errors, over its energy before, below which the declared errors absorb it.
    absorbed = 1e-7, "36 families of a six-joint arm keep 1e-7 to 1e-4 (validation of the prototype)";
    /// Energy of one direction of a family, over its largest before projection, below which it is rounding.
    rounding = 1e-9, "absorbed directions of 1e-21 pass otherwise (validation of the prototype)";
    /// Gain less price that a family must exceed to enter, nats.
    enter = 0.0, "definition of the posterior odds";
    /// Advantage at which a family replaces another in the scan, nats.
    swap_scan = 0.5, "prototype, 200 simulated effects";
    /// Advantage of the whole model at which a replacement is kept, nats.
    swap_model = 0.2, "prototype, 200 simulated effects";
    /// Families active at once, at most, beside those a search starts from.
    most_active = 7.0, "prototype, two to four effects and two kinds of noise";
    /// Family's log price for each class: cost of a smooth function with spectrum n^-4, nats.
    price_smooth = 2.0, "prototype: halved or doubled, 19 of 28 stay in the set";
    /// Cost of the other spectra of smooth functions and of surfaces, nats.
    price_rough = 3.0, "prototype: halved or doubled, 19 of 28 stay in the set";
    /// Cost of a wandering along the order of the rows, nats.
    price_order = 1.0, "prototype: halved or doubled, 19 of 28 stay in the set";
    /// Cost of a step at a date, and of play that has harmonics, nats.
    price_step = 1.0, "prototype: halved or doubled, 19 of 28 stay in the set";
    /// Cost of a product of the first harmonics of two joints, nats.
    price_product = 3.0, "prototype: halved or doubled, 19 of 28 stay in the set";
    /// Cost of a shape at a place where a function is open, nats.
    price_shape = 1.0, "prototype: halved or doubled, 19 of 28 stay in the set";
    /// Cost of every hypothesis of time but order, nats.
    price_time = 2.3, "ln 10: a slow path shares its functions with time";
    /// Sum of n^-2 over the orders of a harmonic, whose logarithm each harmonic pays.
    harmonic_sum = 1.6, "sum of 1/n^2 = 1.64";
    /// Power of n that an order below three pays, in logarithm.
    harmonic_low = 1.0, "prototype: high orders written for low ones 0 of 32";
    /// Power of n that an order of three or more pays, in logarithm.
    harmonic_high = 2.0, "prototype: high orders written for low ones 0 of 32";
    /// Highest order of a harmonic at any place.
    harmonics = 6.0, "prototype of the directions";
    /// Highest order of a harmonic about the joint's own axis.
    harmonics_own = 40.0, "prototype: gears of 9 to 36 teeth";
    /// Highest order about the joint's own axis that is looked for blind.
    orders_own = 5000.0, "worm wheels have up to 720 teeth, motors of drives of 1:160 several waves a turn";
    /// Gain beyond its price at which a wave that was found blind competes, nats.
    wave_offered = 2.0, "160 simulated studies without a wave: none told; of 20 waves of 1.2 times the noise in 200 rows 15 told, none wrong";
    /// Waves that are looked for blind one after another, at most.
    waves_found = 3.0, "bounds work: a worm wheel has its order, twice it, and a gear before it";
    /// Waves of other orders that compete with each, at most.
    waves_near = 4.0, "bounds work: orders that look alike on a grid of readings come in pairs";
    /// Highest order in a smooth function of a joint.
    harmonics_smooth = 14.0, "prototype of the directions";
    /// Highest order of each joint in a surface of two.
    harmonics_surface = 3.0, "prototype of the directions";
    /// Number of joints above which a chain gets the small dictionary.
    few_joints = 3.0, "all families of a six-joint arm would be 50,000 columns";
    /// Shortest distance from 0 and half a turn at which cot of a joint is offered, rad.
    cot_margin = 0.1, "prototype of the directions";
    /// Rows below which tails and uneven variance are not looked for.
    rows_for_weights = 16.0, "prototype: below, the weights follow single rows";
    /// Rows below which memory, wandering and set-ups along the order are not looked for.
    rows_for_order = 20.0, "prototype: below, a random walk has fewer than four steps";
    /// Fewest rows of a set-up that is found without a label, and fewest rows a label has in the mean.
    rows_of_setup = 3.0, "two tilts of a stretch need two rows of two components, and one to judge them by";
    /// Cost of leaving Gaussian tails, nats.
    price_tails = 3.0, "prototype: t3 0 of 100 false, white 0 of 100";
    /// Gain beyond the number of its features at which a variance model is used, nats.
    price_variance = 3.0, "prototype: uneven variance 0 of 100 false";
    /// Prior precision of a coefficient of the log variance per standard deviation of its feature.
    ridge_variance = 4.0, "prototype: uneven variance 0 of 100 false";
    /// Gain at which memory of the noise is used, nats.
    price_memory = 2.0, "two numbers of a grid; AR(.9) 1 of 30 false";
    /// Nats that a cut between two set-ups gives back, as its place is not known to the row.
    cut_slack = 1.5, "prototype: sessions in bands 1 of 92 false";
    /// Set-ups without a label, at most.
    most_setups = 16.0, "prototype: designs of six to twelve sessions";
    /// Gain at which a cut is added, dropped or moved, nats.
    move_cut = 0.3, "prototype: sessions in bands 1 of 92 false";
    /// Lead within which the model with fewer causes is taken, nats.
    fewer_causes = 1.0, "prototype: null cells 3 of 619";
    /// Second-order remainder at which the chain is linearised anew, in standard deviations of the noise.
    relinearise = 0.1, "validation of the prototype, change 5";
    /// Margin at which place and driver are named, nats.
    name_margin = 0.5, "examples/evaluate, seeds from 1000 and 50000 on: 5 of 482 null cases false, 46 of 48 effects told at SNR .3; at 1.5 nats 4 and 43, at 3 nats 0 and 41";
    /// False-alarm rate of a study that says nothing else, for which the margin was chosen; a smaller one asks for a larger margin.
    margin_at = 0.05, "as name_margin; a study that asks for less pays the logarithm of the ratio, as odds bound the rate";
    /// Distance of two scores below which two causes are one to the data, nats.
    even = 0.05, "odds of 1.05 decide nothing: the first of the catalogue stands for both";
    /// Gain, beside nothing or in a cause's place, from which a family competes where a contest is repeated on some of its rows, nats.
    repeated = 1.0, "eight simulated studies, contests repeated in six: every report the same from 0.3 to 4 nats as with all families, in half the time for 400 rows";
    /// Distance from the best within which an explanation stands in the set, nats.
    set_width = 3.0, "truth in the set 38 of 38 at SNR 1 and 3 (prototype)";
    /// Degrees of freedom below which Student's t replaces the normal quantile.
    t_below = 60.0, "quantiles differ by less than 2 percent above";
    /// Part of the rows at each end of each joint that a region leaves out.
    region_part = 0.3, "outside stack: ten real studies, 53 simulated";
    /// Departure of a rung outside, over the largest tried on a region, at which the rung is struck.
    veto = 3.0, "outside stack: ten real studies, 53 simulated";
    /// Quantile of the distance to the nearest row that says how far a set lies.
    far_quantile = 0.9, "outside stack: ten real studies, 53 simulated";
    /// Part of the rows of the regions that count as inside when left out.
    outside_quantile = 0.95, "definition of the measured region";
    /// Distance beyond the data, over the range of a joint, at which the sets outside are judged.
    outside_range = 0.5, "outside stack: ten real studies, 53 simulated";
}

/// Grid of variances of a family over the noise, in powers of ten over the family's largest eigenvalue: from, to, step.
pub(crate) const SCALES: (f64, f64, f64) = (-1.0, 9.0, 0.1);
/// Grid of degrees of freedom of the tails.
pub(crate) const TAILS: [f64; 5] = [10.0, 5.0, 3.0, 2.0, 1.2];
/// Grid of memory from row to row.
pub(crate) const MEMORY: [f64; 6] = [0.5, 0.8, 0.9, 0.95, 0.98, 0.995];
/// Grid of the part of the noise that has memory.
pub(crate) const PART: [f64; 6] = [0.1, 0.4, 0.7, 0.9, 0.99, 0.999];
/// Correlation lengths of smooth functions of a joint, rad.
pub(crate) const LENGTHS_RAD: [f64; 2] = [0.35, 0.15];
