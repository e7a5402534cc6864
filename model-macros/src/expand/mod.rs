//! From a chain to the tokens of its module: types, methods, constants.

mod arguments;
mod closed_form;
mod exact;
mod names;
mod observable;
mod readings;
mod shown;
#[cfg(test)]
mod tests;
mod tokens;

use codegen::Program;
use codegen::backends::rust::{Pieces, Stages};
use model_core::escape::markdown;
use model_core::{Chain, Mistake, ObservableId, SymbolKind};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

pub use names::Names;
use tokens::tokens;

/// Everything that the expansion looks at.
struct Context<'a> {
    chain: &'a Chain,
    names: &'a Names,
    pieces: Pieces<'a>,
}

/// What a module has a structure of, in order.
const KINDS: [SymbolKind; 4] =
    [SymbolKind::Joint, SymbolKind::Input, SymbolKind::Error, SymbolKind::Constant];

/// The observables of a chain, in order.
fn ids(chain: &Chain) -> impl Iterator<Item = ObservableId> {
    (0u16..).map(ObservableId).take(chain.observables.len())
}

impl Context<'_> {
    /// Whether the chain has symbols of a kind.
    fn has(&self, kind: SymbolKind) -> bool {
        self.chain.symbols_of(kind).next().is_some()
    }
}

/// The code of one pose, of an instrument's own errors and constants.
struct Code<'a> {
    context: &'a Context<'a>,
    stages: Stages,
    outputs: Vec<String>,
}

/// The code of a program.
fn stages<'a>(context: &'a Context<'a>, program: &Program) -> Code<'a> {
    let mut stages = context.pieces.stages(program, "ComplexField::sin_cos");
    let outputs = std::mem::take(&mut stages.outputs);
    Code { context, stages, outputs }
}

impl Code<'_> {
    /// How many values are kept for poses.
    fn kept(&self) -> usize {
        self.stages.kept.len()
    }

    /// What no pose changes, as an array.
    fn prepared(&self) -> TokenStream {
        let names = self.context.names;
        let statements = tokens(&self.stages.prepared, names);
        let kept = self.stages.kept.iter().map(|text| tokens(text, names));
        let errors = self.context.has(SymbolKind::Error).then(|| quote! { let errors = &self.errors; });
        let constants =
            self.context.has(SymbolKind::Constant).then(|| quote! { let constants = &self.constants; });
        quote! { #errors #constants #statements [#(#kept),*] }
    }

    /// What is done for a pose, where `p` is what was kept.
    fn evaluated(&self) -> TokenStream {
        tokens(&self.stages.evaluated, self.context.names)
    }

    /// Both.
    fn both_stages(&self) -> TokenStream {
        let (prepared, evaluated, count) = (self.prepared(), self.evaluated(), count(self.kept()));
        quote! {
            let p: [f64; #count] = { #prepared };
            #evaluated
        }
    }
}

/// The module of a chain.
///
/// # Errors
///
/// Names that would stand for two things in the module.
pub fn module(chain: &Chain, names: &Names) -> Result<TokenStream, Vec<Mistake<Span>>> {
    let mistakes = names::clashes(chain, names);
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let context = Context { chain, names, pieces: Pieces::new(chain) };
    let module = Ident::new(&codegen::snake_case(&chain.name), names.chain());
    let documentation = doc(&if chain.documentation.is_empty() {
        format!("The chain `{}`.", chain.name)
    } else {
        markdown(&chain.documentation)
    });
    let instrument = instrument(&context, &documentation);
    let structures: String = KINDS.iter().map(|&kind| context.pieces.structure(kind)).collect();
    let structures = tokens(&structures, names);
    let rows = (context.has(SymbolKind::Joint) || context.has(SymbolKind::Input)).then(|| rows(&context));
    let ramps = (!chain.ramps.is_empty()).then(ramps);
    let has_angles = !chain.sight_angles.is_empty()
        || chain.observables.iter().any(|observable| !observable.has_components_only());
    let angles = has_angles.then(angles);
    let helpers = exact::helpers(&context);
    Ok(quote! {
        #documentation
        #[allow(
            dead_code,
            non_camel_case_types,
            non_snake_case,
            non_upper_case_globals,
            unused_imports,
            unused_mut,
            unused_variables,
            clippy::default_trait_access,
            clippy::doc_markdown,
            clippy::large_types_passed_by_value,
            clippy::many_single_char_names,
            clippy::needless_range_loop,
            clippy::possible_missing_comma,
            clippy::similar_names,
            clippy::struct_field_names,
            clippy::suboptimal_flops,
            clippy::too_many_lines,
            clippy::trivially_copy_pass_by_ref,
            clippy::unreadable_literal,
            clippy::unused_self
        )]
        pub mod #module {
            use ::trueaxis::__private::{ComplexField, Matrix3, SMatrix, Vector3};

            #instrument
            #structures
            #rows
            #ramps
            #angles
            #helpers
        }
    })
}

/// What readings and angles of lines of sight are made of.
fn angles() -> TokenStream {
    quote! {
        /// The square root.
        fn root(x: f64) -> f64 {
            ComplexField::sqrt(x)
        }

        /// The angle of the point (x, y).
        fn arc_tangent(y: f64, x: f64) -> f64 {
            ::trueaxis::__private::RealField::atan2(y, x)
        }
    }
}

/// What ramps are made of.
fn ramps() -> TokenStream {
    quote! {
        /// `x` between 0 and 1, and the nearer of the two outside; NaN stays NaN.
        fn saturate(x: f64) -> f64 {
            x.clamp(0.0, 1.0)
        }

        /// 1 from 0 on, 0 below; NaN stays NaN.
        fn step(x: f64) -> f64 {
            if x >= 0.0 {
                1.0
            } else if x < 0.0 {
                0.0
            } else {
                x
            }
        }
    }
}

/// What methods of many poses have in common.
fn rows(context: &Context<'_>) -> TokenStream {
    let lengths_differ = tokens(context.pieces.lengths_differ(), context.names);
    quote! {
        #lengths_differ

        /// Fills a slice for each number, row by row.
        fn fill<const N: usize>(
            mut out: [&mut [f64]; N],
            have_length: impl Fn(usize) -> bool,
            value: impl Fn(usize) -> [f64; N],
        ) -> Result<(), LengthsDiffer> {
            let rows = out[0].len();
            if !(out.iter().all(|slice| slice.len() == rows) && have_length(rows)) {
                return Err(LengthsDiffer);
            }
            for row in 0..rows {
                for (slice, number) in out.iter_mut().zip(value(row)) {
                    slice[row] = number;
                }
            }
            Ok(())
        }
    }
}

/// Documentation, as `///` lines would be.
fn doc(text: &str) -> TokenStream {
    text.lines()
        .map(|line| {
            let line = if line.is_empty() { String::new() } else { format!(" {line}") };
            quote! { #[doc = #line] }
        })
        .collect()
}

/// How many, as a number without a suffix.
fn count(number: usize) -> Literal {
    Literal::usize_unsuffixed(number)
}

/// The type of the chain with its methods.
fn instrument(context: &Context<'_>, documentation: &TokenStream) -> TokenStream {
    let Context { chain, names, .. } = context;
    let name = Ident::new(&chain.name, names.chain());
    let errors = context.has(SymbolKind::Error);
    let constants = context.has(SymbolKind::Constant);
    let errors_field = errors.then(|| {
        quote! {
            /// What differs from the design.
            pub errors: Errors,
        }
    });
    let constants_field = constants.then(|| {
        quote! {
            /// The sizes of the geometry.
            pub constants: Constants,
        }
    });
    let default_constants = constants.then(|| quote! { constants: Constants::default() });
    let new = errors.then(|| {
        quote! {
            /// The instrument with these errors, and everything else as declared.
            #[must_use]
            pub fn new(errors: Errors) -> Self {
                Self { errors, #default_constants }
            }
        }
    });
    let lists = [
        (SymbolKind::Joint, "joint"),
        (SymbolKind::Input, "input"),
        (SymbolKind::Error, "error"),
        (SymbolKind::Constant, "constant"),
    ];
    let lists = lists.into_iter().filter(|&(kind, _)| context.has(kind)).map(|(kind, singular)| {
        let symbols = chain.symbols_of(kind).map(|id| chain.symbol(id));
        let (plain, printed): (Vec<&str>, Vec<&str>) =
            symbols.map(|symbol| (symbol.name.as_str(), symbol.latex.as_str())).unzip();
        let count = count(plain.len());
        let capital = singular.to_uppercase();
        let (plain_name, printed_name) = (format_ident!("{capital}_NAMES"), format_ident!("{capital}_LATEX"));
        let plain_doc = doc(&format!("The names of the {singular}s, in order."));
        let printed_doc = doc(&format!("The printed forms of the {singular}s, in LaTeX, in order."));
        quote! {
            #plain_doc
            pub const #plain_name: [&'static str; #count] = [#(#plain),*];
            #printed_doc
            pub const #printed_name: [&'static str; #count] = [#(#printed),*];
        }
    });
    let chain_name = &chain.name;
    let observables: TokenStream = ids(chain).map(|id| observable::items(context, id)).collect();
    quote! {
        #documentation
        ///
        /// Angles are radians, lengths metres. `Default` is the instrument as designed.
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct #name {
            #errors_field
            #constants_field
        }

        impl #name {
            /// The declared name.
            pub const NAME: &'static str = #chain_name;
            #(#lists)*
            #new
            #observables
        }
    }
}
