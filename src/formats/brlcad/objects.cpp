#include "formats/brlcad/objects.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <utility>

#include "formats/brlcad/densities.hpp"
#include "formats/brlcad/parts.hpp"

namespace csgrt {

bool is_brlcad_nothing(std::string_view type) {
    constexpr std::string_view types[] = {"grip", "joint", "annot", "datum", "script", "constrnt", "material"};
    return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

static std::string type_of(const BrlcadItem& item) {
    if (const auto* nothing = std::get_if<BrlcadNothing>(&item.content)) return nothing->type;
    return std::holds_alternative<Sketch>(item.content) ? "sketch" : "binunif";
}

void BrlcadObjects::add(Combination combination, std::size_t offset) {
    add(Entry{combination.name, combination.place, std::move(combination)}, offset);
}

void BrlcadObjects::add(const std::string& name, BrlcadItem item, Place place, std::size_t offset) {
    if (auto* sketch = std::get_if<Sketch>(&item.content)) sketch->name = name;
    add(Entry{name, std::move(place), std::move(item)}, offset);
}

void BrlcadObjects::add_broken(const std::string& name, std::string type, Fault fault) {
    if (!findings_.is_lenient() || name.empty()) return findings_.tolerate(std::move(fault), name, "left out");
    const std::size_t offset = fault.offset;
    if (!fault.suggestion.empty()) fault.message += "; " + fault.suggestion;
    Shape shape(Unsupported{std::move(type), std::move(fault.message)});
    add(name, {std::move(shape)}, findings_.place(offset, name), offset);
}

void BrlcadObjects::add(Entry entry, std::size_t offset) {
    const auto [found, is_new] = index_.try_emplace(entry.name, entries_.size());
    if (!is_new) {
        const Place& first = entries_[found->second].place;
        const std::string where =
            first.line > 0 ? "on line " + std::to_string(first.line) : "at byte " + std::to_string(first.offset);
        findings_.tolerate({offset, "this name is taken by the object " + where,
                            "rename one of them: combinations refer to objects by name"},
                           entry.name, "this one is left out");
        return;
    }
    entries_.push_back(std::move(entry));
}

const BrlcadObjects::Entry* BrlcadObjects::find(const std::string& name) const {
    const auto found = index_.find(name);
    return found == index_.end() ? nullptr : &entries_[found->second];
}

Combination* BrlcadObjects::find_combination(const std::string& name) {
    const auto found = index_.find(name);
    return found == index_.end() ? nullptr : std::get_if<Combination>(&entries_[found->second].object);
}

std::vector<bool> BrlcadObjects::used_entries() const {
    std::vector<bool> used(entries_.size());
    for (const Entry& entry : entries_) {
        const auto* combination = std::get_if<Combination>(&entry.object);
        if (combination == nullptr) continue;
        for (const TreeNode& node : combination->tree.nodes) {
            if (node.op != Operator::leaf) continue;
            if (const auto found = index_.find(node.object); found != index_.end()) used[found->second] = true;
        }
    }
    return used;
}

namespace {

/// Removes noise from the last rows of matrices: small entries that stem from rounding to single precision, not from
/// perspective.
class NoiseRemover {
public:
    void remove(Matrix& matrix, const std::string& object, const Place& place) {
        if (matrix[12] == 0 && matrix[13] == 0 && matrix[14] == 0) return;
        double most = 0;
        for (std::size_t i = 12; i < 15; ++i) most = std::max(most, std::abs(matrix[i] / matrix[15]));
        if (!(most <= single_precision)) return;  // also for NaN: validation refuses the matrix where it is used
        for (std::size_t i = 12; i < 15; ++i) matrix[i] = 0;
        if (warning_.count == 0) {
            warning_.object = object;
            warning_.place = place;
        } else if (warning_.object != object) {
            warning_.object.clear();
        }
        ++warning_.count;
    }
    /// Adds one warning for all matrices: in a file with noise, nearly every matrix has it.
    void tell(std::vector<Warning>& warnings) {
        if (warning_.count > 0) warnings.push_back(std::move(warning_));
    }

private:
    static constexpr double single_precision =
        1e-6;  // relative to the last row's last entry; BRL-CAD's importer accepts as much

    Warning warning_{
        {}, {}, "the last row of a matrix is not 0 0 0 w by the noise of single precision, which is divided out", 0};
};

}  // namespace

void BrlcadObjects::add_balls(const Entry& entry, const BrlcadPoints& points, bool used, std::vector<Object>& objects,
                              std::vector<Warning>& warnings) const {
    if (points.without_scale > 0) {
        warnings.push_back(
            {entry.name, entry.place, "a point without a scale has no inside; it is left out", points.without_scale});
    }
    if (points.balls.empty() && !used) return;
    Combination all;
    all.name = entry.name;
    all.place = entry.place;
    all.region = true;  // a region inside another region has no effect
    all.material_id = all.los = 0;
    std::size_t number = 0;
    for (const BrlcadPoints::Ball& ball : points.balls) {
        std::string name;
        do {
            name = entry.name + "." + std::to_string(++number);
        } while (contains(name));
        const double r = ball.radius;
        TreeNode leaf;
        leaf.object = name;
        leaf.place = entry.place;
        all.tree.nodes.push_back(std::move(leaf));
        objects.emplace_back(Solid{std::move(name), Ell{ball.center, {r, 0, 0}, {0, r, 0}, {0, 0, r}}, entry.place});
    }
    if (points.balls.size() > 1) {
        TreeNode node;
        node.op = Operator::union_;
        node.arity = static_cast<std::uint32_t>(points.balls.size());
        node.place = entry.place;
        all.tree.nodes.push_back(std::move(node));
    }
    objects.emplace_back(std::move(all));
}

void BrlcadObjects::take(Scene& scene, const std::string& model, const std::vector<std::string>& file_folders) {
    const auto find_part = [this](const std::string& name) -> const BrlcadItem* {
        const Entry* entry = find(name);
        return entry == nullptr ? nullptr : std::get_if<BrlcadItem>(&entry->object);
    };
    BrlcadParts parts(std::filesystem::path(model).parent_path(), file_folders, find_part);
    const std::vector<bool> used = used_entries();
    std::vector<Object>& objects = scene.objects;
    NoiseRemover noise;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& entry = entries_[i];
        if (auto* combination = std::get_if<Combination>(&entry.object)) {
            for (TreeNode& node : combination->tree.nodes) noise.remove(node.matrix, entry.name, node.place);
            objects.emplace_back(std::move(*combination));
            continue;
        }
        auto& item = std::get<BrlcadItem>(entry.object);
        if (auto* shape = std::get_if<Shape>(&item.content)) {
            std::visit(
                [&](auto& solid) {
                    if constexpr (requires { solid.matrix; }) noise.remove(solid.matrix, entry.name, entry.place);
                },
                *shape);
            parts.complete(*shape, item.cells_in_object);
            objects.emplace_back(Solid{entry.name, std::move(*shape), entry.place});
        } else if (const auto* points = std::get_if<BrlcadPoints>(&item.content)) {
            add_balls(entry, *points, used[i], objects, scene.warnings);
        } else if (used[i] && findings_.is_lenient()) {
            const std::string type = type_of(item);
            objects.emplace_back(
                Solid{entry.name, Shape(Unsupported{type, "a " + type + " has no inside"}), entry.place});
        } else if (used[i]) {
            Combination empty;
            empty.name = entry.name;
            empty.place = entry.place;
            objects.emplace_back(std::move(empty));
        }
    }
    noise.tell(scene.warnings);
    const BrlcadItem* const densities = find_part(densities_name);
    const auto* numbers = densities ? std::get_if<BrlcadNumbers>(&densities->content) : nullptr;
    if (numbers && (numbers->type == BrlcadNumbers::bytes || numbers->type == BrlcadNumbers::signed_bytes))
        scene.densities = read_densities(TextSource(model + ": " + densities_name, numbers->data), densities_name,
                                         findings_.is_lenient() ? &scene.warnings : nullptr);
    entries_.clear();
    index_.clear();
}

}  // namespace csgrt
