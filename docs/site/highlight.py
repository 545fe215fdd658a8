# Colours code with Pygments: a list of [language, code] as JSON from standard input, the HTML of
# each to standard output. Classes: c comment, k keyword, s string, n number, f name that the
# language or its library gives.
import html
import itertools
import json
import sys

from pygments.lexers import get_lexer_by_name
from pygments.token import Comment, Keyword, Literal, Name, Operator

KINDS = [(Comment, "c"), (Keyword, "k"), (Operator.Word, "k"), (Literal.String, "s"),
         (Literal.Number, "n"), (Name.Builtin, "f"), (Name.Function, "f"), (Name.Tag, "k"),
         (Name.Attribute, "f")]


def kind_of(token):
    return next((name for group, name in KINDS if token[0] in group), None)


def coloured(language, code):
    tokens = get_lexer_by_name(language, stripnl=False, ensurenl=False).get_tokens(code)
    parts = []
    for name, run in itertools.groupby(tokens, kind_of):
        text = html.escape("".join(text for _, text in run), quote=False)
        parts.append(f'<span class="{name}">{text}</span>' if name else text)
    return "".join(parts)


json.dump([coloured(*one) for one in json.load(sys.stdin)], sys.stdout)
