//! Names that C and C++ give a meaning of their own.

use crate::backends::names::Rules;

/// Letters beyond ASCII are written by their number: compilers differ in what they take.
pub(crate) const RULES: Rules =
    Rules { words: &RESERVED, starts: &STARTS, takes_letters: false, longest: usize::MAX };

/// What the languages keep for themselves, and macros of standard headers and of the kernel.
#[rustfmt::skip]
const STARTS: [&str; 45] = [
    "__", "_A", "_B", "_C", "_D", "_E", "_F", "_G", "_H", "_I", "_J", "_K", "_L", "_M", "_N", "_O", "_P", "_Q", "_R",
    "_S", "_T", "_U", "_V", "_W", "_X", "_Y", "_Z", "TRUEAXIS_", "INT8", "INT16", "INT32", "INT64", "INT_", "INTMAX_",
    "INTPTR_", "UINT8", "UINT16", "UINT32", "UINT64", "UINT_", "UINTMAX_", "UINTPTR_", "SIZE_", "PTRDIFF_", "WCHAR_",
];

/// Words of C and C++ that a name in a declaration may be, and macros of standard headers and of common compilers.
#[rustfmt::skip]
const RESERVED: [&str; 106] = [
    "EOF", "I", "NULL", "alignas", "alignof", "and", "and_eq", "asm", "assert", "auto", "bitand", "bitor",
    "bool", "break", "case", "catch", "char", "char16_t", "char32_t", "char8_t", "class", "co_await",
    "co_return", "co_yield", "compl", "complex", "concept", "const", "const_cast", "consteval",
    "constexpr", "constinit", "decltype", "default", "delete", "do", "double", "dynamic_cast", "else",
    "enum", "errno", "explicit", "export", "extern", "false", "float", "for", "friend", "goto", "i386",
    "if", "imaginary", "inline", "int", "linux", "long", "mutable", "namespace", "new", "noexcept",
    "noreturn", "not", "not_eq", "nullptr", "offsetof", "operator", "or", "or_eq", "private", "protected",
    "public", "register", "reinterpret_cast", "requires", "restrict", "return", "short", "signed",
    "sizeof", "static", "static_assert", "static_cast", "stderr", "stdin", "stdout", "struct", "switch",
    "template", "this", "thread_local", "throw", "true", "typedef", "typeid", "typename", "typeof",
    "typeof_unqual", "union", "unix", "unsigned", "using", "void", "volatile", "wchar_t", "while", "xor",
];
