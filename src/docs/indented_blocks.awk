# SPDX-License-Identifier: GPL-3.0-or-later
# Filter of Doxygen's input. Formulas and code in comments are indented by four blanks more than their text;
# Markdown takes them for a block only behind an empty line, which the sources leave out.
{
    block = $0 ~ /^ *\/\/\/     +[^ ]/
    comment = $0 ~ /^ *\/\/\//
    if (comment && text_before && block != block_before) {
        match($0, /^ */)
        printf "%*s///\n", RLENGTH, ""
    }
    print
    text_before = comment && $0 ~ /\/\/\/ *[^ ]/
    block_before = block
}
