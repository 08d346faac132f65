#include "formats/json/names.hpp"
#include "formats/json/solid_readers.hpp"

namespace csgrt {

Shape read_json_part(const JsonObject& o) {
    return Part{o["base"].lengths(), o["height"].lengths(), o["radius"].length(), o["top_radius"].length()};
}

Shape read_json_epa(const JsonObject& o) {
    return Epa{o["base"].lengths(), o["height"].lengths(), o["a"].direction(), o["r1"].length(), o["r2"].length()};
}

Shape read_json_rpc(const JsonObject& o) {
    return Rpc{o["base"].lengths(), o["height"].lengths(), o["b"].lengths(), o["half_width"].length()};
}

Shape read_json_rhc(const JsonObject& o) {
    return Rhc{o["base"].lengths(), o["height"].lengths(), o["b"].lengths(), o["half_width"].length(), o["c"].length()};
}

Shape read_json_eto(const JsonObject& o) {
    return Eto{o["center"].lengths(), o["axis"].vector(), o["c"].lengths(), o["radius"].length(), o["d"].length()};
}

Shape read_json_hyp(const JsonObject& o) {
    return Hyp{o["base"].lengths(), o["height"].lengths(), o["a"].lengths(), o["b"].length(), o["neck"].number()};
}

Shape read_json_superell(const JsonObject& o) {
    return Superell{o["center"].lengths(), o["a"].lengths(), o["b"].lengths(),
                    o["c"].lengths(),      o["n"].number(1), o["e"].number(1)};
}

Shape read_json_hrt(const JsonObject& o) {
    return Hrt{o["center"].lengths(), o["x"].lengths(), o["y"].lengths(), o["z"].lengths(), o["d"].length()};
}

Shape read_json_metaball(const JsonObject& o) {
    Metaball solid;
    solid.method = static_cast<Metaball::Method>(
        o["method"].choice(json_metaball_methods, static_cast<std::size_t>(solid.method)));
    solid.threshold = o["threshold"].number(solid.threshold);
    if (!o.has("points")) return solid;
    for (const JsonNode& item : o["points"].items()) {
        const JsonObject point(item, json_form("metaball_point"));
        solid.points.push_back({point["position"].lengths(), point["strength"].length(), point["softness"].number(1)});
    }
    return solid;
}

Shape read_json_pipe(const JsonObject& o) {
    Pipe solid;
    if (!o.has("points")) return solid;
    for (const JsonNode& item : o["points"].items()) {
        const JsonObject point(item, json_form("pipe_point"));
        solid.points.push_back(
            {point["position"].lengths(), point["outer"].length(), point["inner"].length(), point["bend"].length()});
    }
    return solid;
}

Shape read_json_cline(const JsonObject& o) {
    return Cline{o["base"].lengths(), o["height"].lengths(), o["radius"].length(), o["thickness"].length()};
}

}  // namespace csgrt
