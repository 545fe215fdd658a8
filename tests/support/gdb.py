# Shows the engine's values in gdb:
#
#   (gdb) source tests/support/gdb.py
#   (gdb) print *row                  a row of spans, one line for each span
#   (gdb) print *area                 the edges of a row, and the cells on their right
#   (gdb) print $layers(composer)     the layers present at the place of the composer's walk
import gdb
import gdb.printing


def colour(values):
    return "(" + " ".join("%g" % float(values[i]) for i in range(4)) + ")"


class SpanPrinter:
    """[3, 7) gradient (0.1 0.2 0.3 1) + (0.1 0 0 0) * (x - 3)"""

    def __init__(self, span):
        self.span = span

    def to_string(self):
        span = self.span
        kind = str(span["kind"]).replace("CELSPAN_SPAN_", "").lower()
        text = "[%d, %d) %s " % (span["x0"], span["x1"], kind)
        if kind == "gradient":
            slope, origin = colour(span["slope"]), int(span["origin"])
            return text + "%s + %s * (x - %d)" % (colour(span["colour"]), slope, origin)
        if kind != "array":
            return text + colour(span["colour"])
        return text + ("of codes" if span["array"] == 0 else "from %s on" % colour(span["array"]))


class RowPrinter:
    def __init__(self, row):
        self.row = row

    def to_string(self):
        return "%d spans" % self.row["count"]

    def children(self):
        for i in range(int(self.row["count"])):
            yield "[%d]" % i, self.row["spans"][i]


class AreaPrinter:
    """[0] = layer 0 at 2.9 to 2.7: 0.2 of [2, 3), then (1 0 0 1), once the edges are measured."""

    def __init__(self, area):
        self.active, self.edges = area["tools"]["active"], area["edges"]
        self.cells = area["tools"]["cells"]["cells"]

    def to_string(self):
        return "%d edges" % self.active["count"]

    def children(self):
        active, edges = self.active, self.edges
        for i in range(int(active["count"])):
            cell = self.cells[i + 1]
            yield "[%d]" % i, "layer %d at %g to %g: %g of [%d, %d), then %s" % (
                active["crossing"][i]["layer"], active["x"][i], active["x_next"][i],
                edges["one"][i], edges["first"][i], edges["end"][i],
                "a program" if cell["length"] else colour(cell["colour"]))


class Layers(gdb.Function):
    """$layers(COMPOSER): the numbers of the layers whose bit is set in its set."""

    def __init__(self):
        super().__init__("layers")

    def invoke(self, composer):
        words = composer["set"]
        count = int(composer["stack"]["layer_count"])
        here = [i for i in range(count) if int(words[i // 64]) >> i % 64 & 1]
        return "%d of %d layers: %s" % (len(here), count, " ".join(map(str, here)))


printers = gdb.printing.RegexpCollectionPrettyPrinter("celspan")
printers.add_printer("span", "^celspan_span$", SpanPrinter)
printers.add_printer("area", "^cs_area$", AreaPrinter)
printers.add_printer("row", "^cs_row$", RowPrinter)
gdb.printing.register_pretty_printer(None, printers, replace=True)
Layers()
