//! Claims of what is there: a point, a frame, a Jacobian, an image point.

use model_core::algebra::{Poly, Rational};
use model_core::expr::{Expr, Node};
use model_core::{Axis, BodyId, Mistake, ObservableId, SymbolId, SymbolKind, names, syntax};
use toml::{Spanned, Value};

use super::super::strings::place_in_string;
use super::super::table::{CameraTable, ClaimTable, Texts};
use super::{Place, Reader, each};
use crate::checker::entries::{Camera, Entries, EntriesOf};
use crate::checker::{Claim, Order, PrintedVector, lower, prints_letters};
use crate::latex::{self, NameOf, PrintedMatrix, program};

impl Reader<'_> {
    /// Where a point is, or where a direction points.
    pub(super) fn shows(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let texts = claim.shows.as_ref()?;
        let observable = self.vector(claim)?;
        let shown = self.chain.observable(observable);
        let only = self.component(claim, shown)?;
        let claimed = |at: usize| only.is_none_or(|only| only.index() == at);
        let labels = shown.labels().enumerate().filter(|(at, _)| claimed(*at));
        let labels: Vec<String> = labels.map(|(_, label)| label.to_owned()).collect();
        self.several(claim, texts, (EntriesOf::Shown(observable), only), labels)
    }

    /// How a body stands, as a matrix of three or four rows.
    pub(super) fn frame(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let text = claim.frame.as_ref()?;
        let Some(body) = &claim.body else {
            self.mistake(claim.name.span(), "the claim does not say of which body").help =
                Some("body = \"…\"".to_owned());
            return None;
        };
        let body = self.body(body)?;
        let frame = match &claim.within {
            Some(frame) if frame.get_ref() == "ground" => None,
            Some(frame) => Some(self.body(frame)?),
            None => None,
        };
        let matrix = self.one_matrix(text)?;
        if !matches!((matrix.rows, matrix.columns), (3, 3) | (4, 4) | (3, 4)) {
            let message = format!(
                "{} rows and {} columns, where a frame has 3 × 3 or 4 × 4",
                matrix.rows, matrix.columns
            );
            self.mistake(text.span(), message);
            return None;
        }
        if matrix.rows != matrix.columns {
            self.mistake(text.span(), "a row is missing below this matrix").help =
                Some("its last row is `0 & 0 & 0 & 1`".to_owned());
            return None;
        }
        let of = EntriesOf::Frame { body, frame, is_homogeneous: matrix.columns == 4 };
        let labels = numbered(matrix.rows, matrix.columns);
        self.entries(claim, text.span(), matrix, (of, None), labels)
    }

    pub(super) fn jacobian(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let text = claim.jacobian.as_ref()?;
        let observables = self.observables(claim)?;
        let by = self.variables(claim)?;
        let by_errors = by.iter().all(|&id| self.chain.symbol(id).kind == SymbolKind::Error);
        for &observable in &observables {
            let shown = self.chain.observable(observable);
            if !by_errors && !shown.has_components_only() && !shown.is_orientation() {
                self.mistake(claim.name.span(), "the derivatives of an angle are known by errors only")
                    .help =
                    Some("give errors as `by`, or name an observable that shows components".to_owned());
                return None;
            }
        }
        let only = match (observables.as_slice(), &claim.component) {
            (&[one], _) => self.component(claim, self.chain.observable(one))?,
            (_, None) => None,
            (_, Some(component)) => {
                self.mistake(component.span(), "one row is claimed of several observables").help =
                    Some("name one observable".to_owned());
                return None;
            }
        };
        let matrix = self.one_matrix(text)?;
        let rows: usize = observables.iter().map(|&id| self.chain.observable(id).shown.len()).sum();
        let rows = if only.is_some() { 1 } else { rows };
        if [matrix.rows, matrix.columns] != [rows, by.len()] {
            let message = format!(
                "{} × {} entries, where {rows} numbers are shown and {} symbols vary",
                matrix.rows,
                matrix.columns,
                by.len()
            );
            self.mistake(text.span(), message);
            return None;
        }
        let chain = self.chain;
        let by = &by;
        let labels = observables
            .iter()
            .flat_map(|&id| chain.observable(id).labels().enumerate())
            .filter(|(at, _)| only.is_none_or(|only| only.index() == *at))
            .map(|(_, label)| label)
            .flat_map(|row| by.iter().map(move |&id| format!("∂{row}/∂{}", chain.symbol(id).name)))
            .collect();
        let of = EntriesOf::Jacobian { observables, by: by.clone() };
        self.entries(claim, text.span(), matrix, (of, only), labels)
    }

    pub(super) fn image(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let texts = claim.image.as_ref()?;
        let observable = self.vector(claim)?;
        let Some(table) = &claim.camera else {
            self.mistake(claim.name.span(), "the claim does not say what camera sees the point").help =
                Some("camera = { focal = \"f\", center = [\"cx\", \"cy\"] }".to_owned());
            return None;
        };
        let camera = self.camera(observable, table.get_ref())?;
        let labels = vec!["u".to_owned(), "v".to_owned()];
        self.several(claim, texts, (EntriesOf::Image(Box::new(camera)), None), labels)
    }

    /// An observable that shows components of a vector, all three.
    fn vector(&mut self, claim: &ClaimTable) -> Option<ObservableId> {
        let observable = self.observable(claim)?;
        let shown = self.chain.observable(observable);
        if shown.is_vector() && !shown.is_orientation() {
            return Some(observable);
        }
        let place = claim.observable.as_ref().map_or(claim.name.span(), Spanned::span);
        self.mistake(place, format!("`{}` does not show the three components of a vector", shown.name))
            .help = Some(
            "name a direction or a point without readings; how a body stands is `frame = '…'`".to_owned(),
        );
        None
    }

    fn body(&mut self, name: &Spanned<String>) -> Option<BodyId> {
        let chain = self.chain;
        let found = chain.bodies.iter().position(|body| body.name == *name.get_ref());
        let id = found.and_then(|at| u16::try_from(at).ok()).map(BodyId);
        if id.is_none() {
            let near = names::nearest(name.get_ref(), chain.bodies.iter().map(|body| body.name.as_str()));
            let help = near.map(|near| format!("did you mean `{near}`?"));
            self.mistake(name.span(), format!("chain {} has no body `{}`", chain.name, name.get_ref()))
                .help = help;
        }
        id
    }

    /// What a Jacobian derives by.
    fn variables(&mut self, claim: &ClaimTable) -> Option<Vec<SymbolId>> {
        let chain = self.chain;
        let Some(by) = &claim.by else { return Some(chain.symbols_of(SymbolKind::Joint).collect()) };
        let mut found = Vec::new();
        for (name, place) in each(by) {
            let kinds = [SymbolKind::Joint, SymbolKind::Error, SymbolKind::Constant, SymbolKind::Input];
            match chain.find_symbol(name).filter(|&id| kinds.contains(&chain.symbol(id).kind)) {
                Some(id) => found.push(id),
                None => {
                    let near = names::nearest(name, chain.symbols.iter().map(|symbol| symbol.name.as_str()));
                    let help = near.map(|near| format!("did you mean `{near}`?"));
                    self.mistake(place, format!("chain {} has no symbol `{name}`", chain.name)).help = help;
                    return None;
                }
            }
        }
        Some(found)
    }

    fn camera(&mut self, point: ObservableId, table: &CameraTable) -> Option<Camera> {
        let focal = self.amounts(&table.focal)?;
        let focal = match focal.as_slice() {
            [both] => [both.clone(), both.clone()],
            [u, v] => [u.clone(), v.clone()],
            _ => {
                self.mistake(table.focal.span(), "a camera has one focal length, or one for u and one for v");
                return None;
            }
        };
        let center = match &table.center {
            None => [Poly::zero(), Poly::zero()],
            Some(texts) => match <[Poly; 2]>::try_from(self.amounts(texts)?) {
                Ok(center) => center,
                Err(_) => {
                    self.mistake(texts.span(), "a principal point has two coordinates");
                    return None;
                }
            },
        };
        let radial = match &table.radial {
            None => Vec::new(),
            Some(texts) => self.amounts(texts)?,
        };
        let axes = match &table.axes {
            None => [Axis::X, Axis::Y, Axis::Z],
            Some(texts) => {
                let axis = |name: &str| match name {
                    "x" => Some(Axis::X),
                    "y" => Some(Axis::Y),
                    "z" => Some(Axis::Z),
                    _ => None,
                };
                let named: Vec<Axis> = each(texts).into_iter().filter_map(|(name, _)| axis(name)).collect();
                match <[Axis; 3]>::try_from(named) {
                    Ok(axes) if axes[0] != axes[1] && axes[1] != axes[2] && axes[0] != axes[2] => axes,
                    _ => {
                        self.mistake(
                            texts.span(),
                            "the axes of u, of v and of sight are x, y and z in some order",
                        )
                        .help = Some("axes = [\"x\", \"y\", \"z\"]".to_owned());
                        return None;
                    }
                }
            }
        };
        Some(Camera { point, axes, focal, center, radial, is_change: table.change })
    }

    fn amounts(&mut self, texts: &Spanned<Texts>) -> Option<Vec<Poly>> {
        let mut found = Vec::new();
        for (text, string) in each(texts) {
            let read = syntax::parse_amount(text).map_err(|mistakes| {
                let first = mistakes.iter().next();
                let place: Place = first.map_or(0..text.len(), |first| first.place.bytes.clone());
                Mistake::new(place, first.map_or("an amount is missing", |first| first.message.as_str()))
            });
            match read.and_then(|amount| lower(self.chain, &amount)) {
                Ok(amount) => found.push(amount),
                Err(Mistake { place, message, help }) => {
                    let place = place_in_string(self.text, string, place);
                    self.mistake(place, message).help = help;
                    return None;
                }
            }
        }
        Some(found)
    }

    /// One printed matrix.
    fn one_matrix(&mut self, text: &Spanned<String>) -> Option<PrintedMatrix> {
        let printed = text.get_ref();
        let symbols = self.symbols.reading(&[printed]);
        let read = if printed.contains(['\\', '{']) {
            latex::read_matrix(printed, &symbols)
        } else {
            let as_latex = || latex::read_matrix(printed, &symbols);
            let of_letters = prints_letters(printed, &symbols);
            let read = program::read_matrix(printed, &symbols);
            read.or_else(|mistake| if of_letters { as_latex().map_err(|_| mistake) } else { Err(mistake) })
        };
        match read {
            Ok(matrix) => Some(matrix),
            Err(Mistake { place, message, help }) => {
                let place = place_in_string(self.text, text.span(), place);
                self.mistake(place, message).help = help;
                None
            }
        }
    }

    /// Several formulas, each in a text of its own, or all in one.
    fn several(
        &mut self,
        claim: &ClaimTable,
        texts: &Spanned<Texts>,
        (of, only): (EntriesOf, Option<Axis>),
        labels: Vec<String>,
    ) -> Option<Claim> {
        let written = each(texts);
        let plain: Vec<&str> = written.iter().map(|(text, _)| *text).collect();
        let names = vec![only.map_or(NameOf::Formula, |axis| NameOf::Component(axis.index())); labels.len()];
        let symbols = self.symbols.reading(&plain);
        let (entries, notes) = match PrintedVector::texts(&symbols, &names, &plain) {
            Ok(read) => read,
            Err(mistakes) => {
                self.unreadable(texts, mistakes);
                return None;
            }
        };
        let mut entries = entries;
        let is_one =
            |entry: &Expr<Place>| matches!(&entry.node, Node::Number(number) if *number == Rational::ONE);
        // The homogeneous coordinate of a point.
        if entries.len() == labels.len() + 1 && entries.last().is_some_and(is_one) {
            entries.pop();
        }
        if entries.len() != labels.len() {
            let message = format!("{} formulas, where {} numbers are shown", entries.len(), labels.len());
            self.mistake(texts.span(), message).help = Some("give one formula for each".to_owned());
            return None;
        }
        let matrix = PrintedMatrix { rows: entries.len(), columns: 1, entries, notes };
        self.entries(claim, texts.span(), matrix, (of, only), labels)
    }

    fn entries(
        &mut self,
        claim: &ClaimTable,
        place: Place,
        matrix: PrintedMatrix,
        (of, only): (EntriesOf, Option<Axis>),
        labels: Vec<String>,
    ) -> Option<Claim> {
        let order = self.order_from_zero(claim)?;
        let kept = self.kept(claim)?;
        match Entries::read(self.chain, matrix, order) {
            Ok(printed) => Some(Claim::Entries(Box::new(Entries { of, order, kept, only, labels, printed }))),
            Err(mistakes) => {
                for Mistake { place: inside, message, help } in mistakes {
                    let place = place_in_string(self.text, place.clone(), inside.bytes);
                    self.mistake(place, message).help = help;
                }
                None
            }
        }
    }

    /// The order of a claim of what is there; without one it is of the perfect instrument.
    fn order_from_zero(&mut self, claim: &ClaimTable) -> Option<Order> {
        match claim.order.as_ref().map(Spanned::get_ref) {
            None | Some(Value::Integer(0)) => Some(Order::UpTo(0)),
            Some(_) => self.order(claim),
        }
    }
}

/// The entries of a matrix by row and column.
fn numbered(rows: usize, columns: usize) -> Vec<String> {
    (1..=rows).flat_map(|row| (1..=columns).map(move |column| format!("entry {row}{column}"))).collect()
}
