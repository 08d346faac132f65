// Reader of BRL-CAD's older text form. Each line is a record, whose first letter is its kind:
//
//     I units version            then a line with the title
//     S type name comgeom 24 numbers, and n s t w p N P b A e c d: solids
//     C Y|N name id air members - material los override r g b shader? parameters? inherit
//                                then the shader's name and parameters on lines of their own if flagged,
//                                then M operator member 16 numbers, one for each member
//     m flags low high r g b     the colour of region ids low to high
//
// Lengths are in millimetres; the unit of I is for display. Matrices are row by row. Members combine from left to
// right: u starts a new term of a union, and + - ^ apply to the term so far. The first member's operator has no
// meaning.
#include <iterator>
#include <utility>
#include <vector>

#include "formats/brlcad/asc.hpp"
#include "formats/brlcad/objects.hpp"
#include "formats/brlcad/shader.hpp"
#include "formats/brlcad/v4/lines.hpp"
#include "formats/brlcad/v4/solids.hpp"

namespace csgrt {

namespace {

/// Names of the unit codes 0 to 9 of a record I.
constexpr const char* unit_codes[] = {"mm", "mm", "cm", "m", "in", "ft", "um", "km", "yd", "mi"};

struct Member {
    Operator op;
    TreeNode leaf;
};

Operator operator_of(const Field& field) {
    if (field.text == "u") return Operator::union_;
    if (field.text == "+") return Operator::intersection;
    if (field.text == "-") return Operator::difference;
    if (field.text == "^") return Operator::xor_;
    throw Fault{field.offset, quoted(field.text) + " is no operator", "operators are u + - ^"};
}

/// The tree of a combination's members. Neighbours with the same operator share one node.
Tree tree_of(std::vector<Member> members) {
    Tree tree;
    std::uint32_t terms = 0;
    for (std::size_t i = 0; i < members.size(); ++terms) {
        tree.nodes.push_back(std::move(members[i++].leaf));
        while (i < members.size() && members[i].op != Operator::union_) {
            TreeNode node;
            node.op = members[i].op;
            node.arity = 1;
            node.place = members[i].leaf.place;
            for (; i < members.size() && members[i].op == node.op; ++i, ++node.arity) {
                tree.nodes.push_back(std::move(members[i].leaf));
            }
            tree.nodes.push_back(std::move(node));
        }
    }
    if (terms > 1) {
        TreeNode node;
        node.op = Operator::union_;
        node.arity = terms;
        node.place = tree.nodes.front().place;
        tree.nodes.push_back(std::move(node));
    }
    return tree;
}

/// Whether the line can be the first of a record, not a later line with its data.
bool starts_record(const Line& line) {
    return line.text.size() > 1 && line.text[1] == ' ' &&
           std::string_view("ISCMmABPQDF#").find(line.text[0]) != std::string_view::npos;
}

/// Reads a v4 database record by record. A broken record becomes a finding, and reading goes on at the next.
class V4Reader {
public:
    V4Reader(const TextSource& source, bool lenient)
        : source_(source),
          scene_(brlcad_scene(lenient)),
          findings_(source, lenient ? &scene_.warnings : nullptr),
          lines_(source.text(), source.begin()),
          objects_(findings_) {}

    Scene read() {
        while (!lines_.at_end()) {
            object_.clear();
            const Line line = lines_.take();
            try {
                read_record(line);
            } catch (Fault& fault) {
                findings_.add(std::move(fault), object_);
            }
        }
        findings_.throw_if_any();
        objects_.take(scene_, source_.name(), source_.file_folders);
        warn_of_shaders(scene_);
        return std::move(scene_);
    }

private:
    void read_record(const Line& line) {
        if (line.text.find_first_not_of(" \t") == std::string_view::npos || line.text[0] == '#') return;
        Fields fields(line);
        const Field letter = fields.next("the record's letter");
        if (letter.text.size() != 1 || line.text[0] != letter.text[0]) return refuse_record(line);
        switch (letter.text[0]) {
            case 'I':
                return tolerate_faults([&] { read_ident(fields); });
            case 'C':
                return read_combination(line, fields);
            case 'm':
                return tolerate_faults([&] { read_color(fields); });
            case 'F':
                return;  // an unused record
            default:
                break;
        }
        if (!is_v4_solid(letter.text[0])) return refuse_record(line);
        BrlcadItem item;
        try {
            item = read_v4_solid(line, lines_, object_);
        } catch (Fault& fault) {
            skip_data();
            return add_broken(type_of(line), std::move(fault));
        }
        objects_.add(object_, std::move(item), source_.place(line.offset, object_), line.offset);
    }

    template <class Read>
    void tolerate_faults(const Read& read) {
        try {
            read();
        } catch (Fault& fault) {
            findings_.tolerate(std::move(fault), object_, passed_over);
        }
    }

    /// Adds a broken object. If the fault is at the end of the file, the file is cut off.
    void add_broken(const char* type, Fault fault) {
        if (source_.text().find_first_not_of(" \t\r\n", fault.offset) == std::string_view::npos) {
            findings_.add(std::move(fault), object_);
        } else {
            objects_.add_broken(object_, type, std::move(fault));
        }
    }

    static const char* type_of(const Line& record) {
        switch (record.text[0]) {
            case 'n':
                return "arbn";
            case 't':
                return "bot";
            case 'w':
                return "pipe";
            case 'N':
                return "nmg";
            case 'p':
                return "part";
            case 'P':
                return "poly";
            case 'b':
                return "bspline";
            case 'A':
                return "ars";
            case 'e':
                return "extrude";
            case 'c':
                return "cline";
            case 'd':
                return "sketch";
            default:
                return "solid";
        }
    }

    /// Adds one finding for consecutive lines that are no records.
    void refuse_record(const Line& line) {
        const char first = line.text[0];
        while (!lines_.at_end() && lines_.peek().text.starts_with(first)) lines_.take();
        if (first == 'M') throw Fault{line.offset, "a member (M) without a combination (C) before it", {}};
        throw Fault{line.offset, "this is no record of a v4 database", "records start with a letter: I S C M m ..."};
    }

    /// Skips the other lines of a broken solid.
    void skip_data() {
        while (!lines_.at_end() && !lines_.peek().text.empty() &&
               std::string_view(" \t+-.0123456789QB").find(lines_.peek().text[0]) != std::string_view::npos) {
            lines_.take();
        }
    }

    void read_ident(Fields& fields) {
        scene_.title = lines_.take().text;
        const int units = fields.integer("the unit's number", 0, static_cast<int>(std::size(unit_codes)) - 1);
        scene_.units = unit_codes[units];
        scene_.unit_length = unit_in_millimetres(scene_.units);
    }

    void read_color(Fields& fields) {
        RegionColor color;
        fields.integer("the flags");
        color.low = fields.integer("the lowest region id");
        color.high = fields.integer("the highest region id");
        color.color = read_rgb(fields);
        fields.end();
        scene_.region_colors.push_back(color);
    }

    static Vec3 read_rgb(Fields& fields) {
        const int r = fields.integer("the colour's red", 0, 255);
        const int g = fields.integer("the colour's green", 0, 255);
        const int b = fields.integer("the colour's blue", 0, 255);
        return color_of_bytes(r, g, b);
    }

    void read_combination(const Line& line, Fields& fields) {
        Combination combination;
        std::vector<Fault> faults;
        bool sound = true;
        try {
            read_attributes(fields, combination);
        } catch (Fault& fault) {
            faults.push_back(std::move(fault));
            sound = false;
            while (!lines_.at_end() && !starts_record(lines_.peek())) lines_.take();
        }
        std::vector<Member> members;
        while (lines_.peek().text.starts_with("M ")) {
            try {
                members.push_back(read_member(lines_.take()));
            } catch (Fault& fault) {
                faults.push_back(std::move(fault));
            }
        }
        if (!faults.empty() && findings_.is_lenient()) return add_broken("comb", std::move(faults.front()));
        for (Fault& fault : faults) findings_.add(std::move(fault), object_);
        if (!sound) return;
        combination.tree = tree_of(std::move(members));
        combination.place = source_.place(line.offset, combination.name);
        objects_.add(std::move(combination), line.offset);
    }

    void read_attributes(Fields& fields, Combination& combination) {
        const Field kind = fields.next("the region flag");
        if (kind.text.size() != 1 || std::string_view("YRPVN").find(kind.text[0]) == std::string_view::npos) {
            throw Fault{kind.offset, quoted(kind.text) + " is no region flag", "Y (or P, V) is a region, N is none"};
        }
        combination.region = kind.text != "N";
        combination.fastgen = fastgen_of(kind.text);
        combination.name = fields.next("the combination's name").text;
        object_ = combination.name;
        combination.region_id = fields.integer("the region id");
        combination.air = fields.integer("the air code");
        fields.integer("the number of members");  // ignored: wrong in many files, and the lines themselves are counted
        fields.integer("the COMGEOM number");
        combination.material_id = fields.integer("the material");
        combination.los = fields.integer("the line-of-sight equivalent");
        const bool has_color = fields.integer("the colour's flag") != 0;
        if (const Vec3 color = read_rgb(fields); has_color) combination.color = color;

        // In the oldest files the line ends here, in later files after the shader's flag.
        const bool has_shader = fields.more() && fields.integer("the shader's flag") != 0;
        const bool has_parameters = fields.more() && fields.integer("the parameters' flag") != 0;
        const bool inherits = fields.more() && fields.integer("the inheritance") != 0;
        fields.end();
        combination.color_inherits = combination.finish_inherits = inherits;
        const std::string_view shader = has_shader ? take_text("the shader's name") : std::string_view{};
        const std::string_view parameters = has_parameters ? take_text("the shader's parameters") : std::string_view{};
        const std::size_t name_length = shader.find_last_not_of(" \t") + 1;
        if (name_length > 0) combination.finish = read_finish(shader.substr(0, name_length), parameters);
    }

    std::string_view take_text(const char* what) {
        const Line line = lines_.peek();
        if (lines_.at_end()) throw Fault{line.offset, std::string("the file ends early: ") + what + " is missing", {}};
        return lines_.take().text;
    }

    Member read_member(const Line& line) {
        Fields fields(line);
        fields.next("the letter M");
        Member member;
        member.op = operator_of(fields.next("the operator"));
        member.leaf.object = fields.next("the member's name").text;
        member.leaf.place = source_.place(line.offset, object_);
        member.leaf.matrix = without_scale(fields.numbers<16>("numbers of the matrix"));
        if (fields.more()) fields.integer("the instance number");
        fields.end();
        return member;
    }

    const TextSource& source_;
    Scene scene_;
    Findings findings_;
    LineReader lines_;
    BrlcadObjects objects_;
    std::string object_;  ///< the name of the current object, once it is known
};

}  // namespace

Scene parse_brlcad_asc_v4(const TextSource& source, bool lenient) { return V4Reader(source, lenient).read(); }

}  // namespace csgrt
