#include <csgrt/scene_io.hpp>
#include "formats/brlcad_asc.hpp"
namespace csgrt { Scene load_scene(const std::string& p){ return read_brlcad_asc(p);} void save_scene(const Scene&, const std::string&){} }
