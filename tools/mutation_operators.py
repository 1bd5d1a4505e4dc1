# SPDX-License-Identifier: Apache-2.0
"""Small changes of C++ sources, each of which a test should notice.

mutants_of(path, text) finds them: relational operators and their neighbours, && and ||, negated conditions, whole
numbers one up and one down, true and false, min and max, statements left out. It reads tokens, as clang-format lays
them out (a binary operator stands between blanks), and leaves alone what is no code that runs: comments, texts,
preprocessor lines, static assertions.
"""

import collections
import hashlib
import re

# begin and end: where in the text; instead: what stands there in the mutant.
Mutant = collections.namedtuple("Mutant", "path begin end instead kind")

TOKEN = re.compile(
    r"""(?P<skip>//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:[^\n\\]|\\.|\\\n)*|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)')
      | (?P<number>\b(?:0[xX][0-9a-fA-F']+|0[bB][01']+|[0-9][0-9']*)(?P<suffix>[uUlLzZ]*)(?![\w.]))
      | (?P<real>\b[0-9][0-9']*\.[0-9]*(?:[eE][-+]?[0-9]+)?[fFlL]?)
      | (?P<word>[A-Za-z_]\w*)
      | (?P<mark><=>|<<=|>>=|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|%=|&=|\|=|\^=|::|[^\s\w])
    """, re.MULTILINE | re.DOTALL | re.VERBOSE)

NEIGHBOURS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
WORDS = {"true": "false", "false": "true", "min": "max", "max": "min"}
# What begins no statement that can be left out: declarations, jumps, and what stands before a block.
KEEPS = {"return", "using", "static", "constexpr", "const", "friend", "template", "typename", "struct", "class", "enum",
         "namespace", "case", "default", "break", "continue", "public", "private", "protected", "extern", "static_assert",
         "explicit", "inline", "auto", "if", "else", "for", "while", "switch", "do", "goto", "throw", "typedef", "operator"}

Token = collections.namedtuple("Token", "text begin end kind")


def tokens_of(text):
    found = []
    for match in TOKEN.finditer(text):
        kind = match.lastgroup if match.lastgroup != "suffix" else "number"
        if kind != "skip":
            found.append(Token(match.group(kind), match.start(), match.end(), kind))
    return found


def closing_of(tokens):
    """For each opening bracket, the index of the one that closes it."""
    closes, open_ = {}, []
    for index, token in enumerate(tokens):
        if token.text in "([{":
            open_.append(index)
        elif token.text in ")]}" and open_:
            closes[open_.pop()] = index
    return closes


def in_static_assertions(tokens, closes):
    inside = set()
    for index, token in enumerate(tokens):
        if token.text == "static_assert" and index + 1 in closes:
            inside.update(range(index, closes[index + 1] + 1))
    return inside


def is_between_blanks(text, token):
    return text[token.begin - 1:token.begin].isspace() and text[token.end:token.end + 1].isspace()


def numbers_beside(token):
    digits = token.text.rstrip("uUlLzZ")
    suffix = token.text[len(digits):]
    plain = digits.replace("'", "")
    base = 16 if plain[:2] in ("0x", "0X") else 2 if plain[:2] in ("0b", "0B") else 10
    value = int(plain, base)
    for other in (value + 1, value - 1):
        if other >= 0:
            yield (hex(other) if base == 16 else str(other)) + suffix


def statement_of(tokens, begin, closes):
    """The index of the semicolon that ends a call, an assignment or a step that begins here, or None."""
    index, assigns, calls = begin, False, False
    while index < len(tokens) and tokens[index].text in ("++", "--", "*", "("):
        assigns = assigns or tokens[index].text in ("++", "--")
        index = closes.get(index, index) + 1
    while index < len(tokens):
        token = tokens[index]
        if token.text == ";":
            return index if assigns or calls else None
        if token.text in ("=", "+=", "-=", "*=", "/=", "|=", "&=", "^=", "<<=", ">>=", "++", "--"):
            assigns = True
        elif token.text in "([{" and index in closes:
            calls = calls or token.text == "("
            index = closes[index]
        elif token.text in "}{":
            return None
        elif not assigns and token.kind == "word" and tokens[index - 1].kind == "word" and index > begin:
            return None  # two words in a row: a declaration
        elif not assigns and tokens[index - 1].text in (">", "&", "*") and token.kind == "word" and index > begin:
            return None  # so is a type with marks after it
        index += 1
    return None


def statements(tokens, closes):
    for index, token in enumerate(tokens):
        begins = index > 0 and tokens[index - 1].text in (";", "{", "}")
        if not begins or token.text in KEEPS or (token.kind != "word" and token.text not in ("++", "--", "*", "(")):
            continue
        end = statement_of(tokens, index, closes)
        if end is not None:
            yield index, end


def mutants_of(path, text):
    tokens = tokens_of(text)
    closes = closing_of(tokens)
    untouched = in_static_assertions(tokens, closes)
    found = []

    def add(begin, end, instead, kind):
        found.append(Mutant(path, begin, end, instead, kind))

    for index, token in enumerate(tokens):
        if index in untouched:
            continue
        if token.text in NEIGHBOURS and is_between_blanks(text, token):
            add(token.begin, token.end, NEIGHBOURS[token.text], "operator")
        elif token.kind == "number":
            for other in numbers_beside(token):
                add(token.begin, token.end, other, "number")
        elif token.text in WORDS and (token.text in ("true", "false") or tokens[index - 1].text == "::"):
            if token.text in ("min", "max") and text[token.end:token.end + 2] == "()":
                continue  # numeric_limits
            add(token.begin, token.end, WORDS[token.text], "word")
        elif token.text in ("if", "while") and tokens[index + 1].text == "(" and index + 1 in closes:
            begin, end = tokens[index + 1].end, tokens[closes[index + 1]].begin
            condition = begin_of_condition(tokens, index + 1, closes)
            begin = condition if condition is not None else begin
            if not is_one_comparison(text[begin:end]):
                add(begin, end, f"!({text[begin:end].strip()})", "condition")
    for begin, end in statements(tokens, closes):
        if begin not in untouched:
            add(tokens[begin].begin, tokens[end].end, ";", "statement")
    return sorted(found, key=lambda mutant: (mutant.begin, mutant.end, mutant.instead))


def is_one_comparison(condition):
    """Negated it would be the mutant that its operator makes."""
    return len(re.findall(r" (==|!=) ", condition)) == 1 and not re.search(r" (&&|\|\|) |!\(", condition)


def begin_of_condition(tokens, opening, closes):
    """Where the condition begins after `if (init; `, or None."""
    index = opening + 1
    while index < closes[opening]:
        if tokens[index].text == ";":
            return tokens[index].end
        index = closes.get(index, index) + 1
    return None


def applied(mutant, text):
    return text[:mutant.begin] + mutant.instead + text[mutant.end:]


def line_of(mutant, text):
    return text.count("\n", 0, mutant.begin) + 1


def lines_of(mutant, text):
    """The lines that it changes, before and after, each as one with single blanks: its name wherever it stands."""
    begin = text.rfind("\n", 0, mutant.begin) + 1
    end = text.find("\n", mutant.end)
    end = len(text) if end < 0 else end
    after = text[begin:mutant.begin] + mutant.instead + text[mutant.end:end]
    return " ".join(text[begin:end].split()), " ".join(after.split())


def identity_of(mutant, text):
    whole = "\0".join((mutant.path, text, str(mutant.begin), str(mutant.end), mutant.instead))
    return hashlib.sha256(whole.encode()).hexdigest()[:16]
