// Cells: solids of binary databases whose cells are in another file or object. An ebm and a vol are a text of keys and
// values. A dsp is width, depth: counts  a matrix of 16 doubles  smooth: 2 bytes  source, cut: letters  a name.
#include "formats/brlcad/codes.hpp"
#include "formats/brlcad/g/solids.hpp"
#include "formats/brlcad/struct_text.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

StructText struct_text(ByteReader& b) {
    const std::size_t at = b.offset();
    return {b.text("the solid's parameters"), at};
}

std::uint32_t side(ByteReader& b, const char* what) {
    const std::size_t at = b.offset();
    const std::uint32_t value = b.word(what);
    if (value == 0) throw Fault{at, std::string(what) + " is 0", {}};
    return value;
}

}  // namespace

BrlcadItem read_g_ebm(ByteReader& b) {
    StructText text = struct_text(b);
    return read_struct_ebm(text);
}

BrlcadItem read_g_vol(ByteReader& b) {
    StructText text = struct_text(b);
    return read_struct_vol(text);
}

BrlcadItem read_g_dsp(ByteReader& b) {
    Dsp dsp;
    dsp.width = side(b, "the dsp's width");
    dsp.depth = side(b, "the dsp's depth");
    Matrix matrix{};
    for (double& element : matrix) element = b.real("an element of the dsp's matrix");
    dsp.matrix = without_scale(matrix);
    dsp.smooth = b.number(1, "the dsp's smoothing") != 0;
    const std::size_t source_at = b.offset();
    const std::string_view source = b.take(1, "the dsp's source");
    if (source != "f" && source != "o" && source != "4") {
        throw Fault{source_at, quoted(source) + " is no kind of source", {}};
    }
    const std::size_t cut_at = b.offset();
    dsp.cut = read_cut(b.take(1, "the dsp's cut"), cut_at);
    dsp.file = b.name("the name of the dsp's source");
    return {Shape(std::move(dsp)), source == "o"};
}

}  // namespace csgrt
