/* csgrt.h in C99 alone: builds a part, asks for what is along a ray, draws it, edits it, verifies it, weighs it
   and checks it. */
#include <csgrt/csgrt.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPECT(condition)                                                                       \
    do {                                                                                        \
        if (!(condition)) {                                                                     \
            fprintf(stderr, "line %d: %s: %s\n", __LINE__, #condition, csgrt_last_error());     \
            exit(1);                                                                            \
        }                                                                                       \
    } while (0)

static int count_calls(void* user, double done) {
    ++*(int*)user;
    return done <= 1;
}

static int end_at_once(void* user, double done) {
    (void)user;
    (void)done;
    return 0;
}

int main(void) {
    csgrt_scene* scene = NULL;
    csgrt_model *model = NULL, *next = NULL;
    csgrt_renderer* renderer = NULL;
    csgrt_image* image = NULL;
    csgrt_edit* edit = NULL;
    csgrt_verifier* verifier = NULL;
    csgrt_measurer* measurer = NULL;
    csgrt_checker* checker = NULL;

    /* A box with a bore. */
    EXPECT(csgrt_scene_create(&scene) == CSGRT_OK);
    {
        const csgrt_member block[] = {CSGRT_MEMBER("low", -10, -10, 0), CSGRT_MEMBER("high", 10, 10, 5)};
        const csgrt_member bore[] = {CSGRT_MEMBER("base", 0, 0, -1), CSGRT_MEMBER("height", 0, 0, 7),
                                     CSGRT_MEMBER("radius", 3)};
        const csgrt_tree_node nodes[] = {CSGRT_OBJECT("block"), CSGRT_OBJECT("bore"), CSGRT_JOIN(CSGRT_DIFFERENCE, 2)};
        csgrt_combination plate = CSGRT_COMBINATION;
        plate.name = "plate";
        plate.nodes = nodes;
        plate.node_count = 3;
        plate.region = 1;
        EXPECT(csgrt_scene_add_solid(scene, "block", "box", block, 2) == CSGRT_OK);
        EXPECT(csgrt_scene_add_solid(scene, "bore", "cylinder", bore, 3) == CSGRT_OK);
        EXPECT(csgrt_scene_add_combination(scene, &plate) == CSGRT_OK);
    }
    EXPECT(csgrt_model_create(scene, NULL, 0, NULL, &model) == CSGRT_OK);

    /* Rays through the middle and beside it, on the renderer's device. */
    {
        int calls = 0;
        csgrt_settings settings = CSGRT_SETTINGS;
        settings.progress = count_calls;
        settings.user = &calls;
        EXPECT(csgrt_renderer_create(model, &settings, &renderer) == CSGRT_OK);
        const csgrt_ray list[] = {{{-20, 0, 2}, {1, 0, 0}}, {{-20, 5, 2}, {2, 0, 0}}, {{0, 0, 20}, {0, 0, -1}}};
        csgrt_rays rays = CSGRT_RAYS;
        csgrt_partition_arrays rows = CSGRT_PARTITION_ARRAYS;
        csgrt_partitions* partitions = NULL;
        rays.list = list;
        rays.count = 3;
        EXPECT(csgrt_partitions_create(&partitions) == CSGRT_OK);
        EXPECT(csgrt_renderer_partitions(renderer, &rays, partitions) == CSGRT_OK);
        EXPECT(csgrt_partitions_get(partitions, &rows) == CSGRT_OK);
        EXPECT(rows.ray_count == 3 && rows.row_count == 3 && calls >= 2);
        EXPECT(rows.ray_splits[1] == 2 && rows.ray_splits[2] == 3 && rows.ray_splits[3] == 3);
        EXPECT(rows.t_in[0] == 10 && rows.t_out[0] == 17 && rows.t_in[2] == 5 && rows.t_out[2] == 15);
        csgrt_partitions_free(partitions);
    }

    /* A picture in 8 bits, and another after an edit. */
    {
        unsigned char before[32 * 24 * 4], after[32 * 24 * 4];
        const csgrt_vec3 green = {0, 1, 0};
        csgrt_view view = CSGRT_VIEW;
        view.width = 32;
        view.height = 24;
        view.channels = CSGRT_CHANNEL_DISPLAY;
        view.every_partition = 0;
        EXPECT(csgrt_image_create(&image) == CSGRT_OK);
        EXPECT(csgrt_renderer_render(renderer, &view, image) == CSGRT_OK);
        EXPECT(csgrt_image_display_pixels(image, before, sizeof before) == CSGRT_OK);
        EXPECT(csgrt_edit_create(model, &edit) == CSGRT_OK);
        EXPECT(csgrt_edit_set_color(edit, "/plate", &green) == CSGRT_OK);
        EXPECT(csgrt_edit_remove(edit, "/plait") == CSGRT_ERROR_USAGE);
        EXPECT(csgrt_edit_commit(edit, &next) == CSGRT_OK);
        EXPECT(csgrt_renderer_set_model(renderer, next) == CSGRT_OK);
        EXPECT(csgrt_renderer_render(renderer, &view, image) == CSGRT_OK);
        EXPECT(csgrt_image_display_pixels(image, after, sizeof after) == CSGRT_OK);
        EXPECT(memcmp(before, after, sizeof after) != 0);
        EXPECT(csgrt_image_display_pixels(image, after, 7) == CSGRT_ERROR_USAGE);
    }

    {
        csgrt_ray rays[100];
        csgrt_verification result = CSGRT_VERIFICATION;
        EXPECT(csgrt_verifier_create(scene, NULL, 0, NULL, &verifier) == CSGRT_OK);
        EXPECT(csgrt_verifier_sample(verifier, NULL, 1, rays, 100) == CSGRT_OK);
        EXPECT(csgrt_verifier_shoot(verifier, rays, 100) == CSGRT_OK);
        EXPECT(csgrt_verifier_result(verifier, &result) == CSGRT_OK);
        EXPECT(result.rays == 100 && result.hits > 0);
    }

    /* The plate weighs what its volume of steel does, of which the model's table tells nothing. */
    {
        const csgrt_density steel = {1, NULL, 7.85, "steel"};
        csgrt_measure_request request = CSGRT_MEASURE_REQUEST;
        csgrt_measurement result = CSGRT_MEASUREMENT;
        csgrt_measured part = CSGRT_MEASURED;
        csgrt_measured_grid grid = CSGRT_MEASURED_GRID;
        const double volume = 20 * 20 * 5 - 3.14159265358979 * 3 * 3 * 5;
        request.rel_error = 1e-3;
        request.densities = &steel;
        request.density_count = 1;
        EXPECT(csgrt_measurer_create(model, NULL, &measurer) == CSGRT_OK);
        EXPECT(csgrt_measurer_measure(measurer, &request, &result) == CSGRT_OK);
        EXPECT(result.reached && result.has_densities && result.parts == 3);
        EXPECT(csgrt_measurer_part(measurer, 2, &part) == CSGRT_OK);
        EXPECT(part.kind == CSGRT_MEASURED_REGION && strcmp(part.name, "/plate") == 0 && part.id == 0);
        EXPECT(part.volume.half_width > 0 && part.volume.half_width < 1e-3 * volume);
        EXPECT(part.volume.value > 0.998 * volume && part.volume.value < 1.002 * volume);
        EXPECT(part.mass.value > 0.998 * 7.85e-6 * volume && part.mass.value < 1.002 * 7.85e-6 * volume);
        EXPECT(csgrt_measurer_part(measurer, 3, &part) == CSGRT_ERROR_USAGE);
        request.grid[0] = request.grid[1] = 2;
        request.grid[2] = 1;
        EXPECT(csgrt_measurer_measure(measurer, &request, &result) == CSGRT_OK);
        EXPECT(csgrt_measurer_grid(measurer, &grid) == CSGRT_OK);
        EXPECT(grid.sides[1] == 2 && grid.box.high.x == 10 && grid.regions.count == 4 && grid.materials.count == 4);
        EXPECT(grid.regions.cells[3] == 1 && grid.regions.cells[4] == 0 && grid.regions.ids[3] == 0);
        EXPECT(grid.regions.volumes[3] > 0.99 * volume / 4 && grid.regions.volumes[3] < 1.01 * volume / 4);
        EXPECT(grid.regions.half_widths[3] > 0 && grid.materials.volumes[3] == grid.regions.volumes[3]);
        request.rel_error = 0;
        EXPECT(csgrt_measurer_measure(measurer, &request, &result) == CSGRT_ERROR_USAGE);
    }

    /* A peg that is 0.5 mm too thick for the bore, and a half space that touches the plate. */
    {
        const csgrt_member thick[] = {CSGRT_MEMBER("base", 0, 0, 1), CSGRT_MEMBER("height", 0, 0, 2),
                                      CSGRT_MEMBER("radius", 3.5)};
        const csgrt_member below[] = {CSGRT_MEMBER("normal", 0, 0, 1), CSGRT_MEMBER("distance", 0)};
        const csgrt_tree_node peg_node = CSGRT_OBJECT("thick"), ground_node = CSGRT_OBJECT("below");
        const csgrt_allowed_overlap rows[] = {{"/peg", "/pl*"}, {"/peg", "/ground"}};
        csgrt_combination peg = CSGRT_COMBINATION, ground;
        csgrt_check_request request = CSGRT_CHECK_REQUEST;
        csgrt_check_result result = CSGRT_CHECK_RESULT;
        csgrt_found_overlap overlap = CSGRT_FOUND_OVERLAP;
        csgrt_unlisted_pair pair = CSGRT_UNLISTED_PAIR;
        csgrt_allowed_overlap unused;
        csgrt_settings settings = CSGRT_SETTINGS;
        uint32_t open_region = 0;
        double squared;
        peg.name = "peg";
        peg.nodes = &peg_node;
        peg.node_count = 1;
        peg.region = 1;
        ground = peg;
        ground.name = "ground";
        ground.nodes = &ground_node;
        EXPECT(csgrt_scene_add_solid(scene, "thick", "cylinder", thick, 3) == CSGRT_OK);
        EXPECT(csgrt_scene_add_solid(scene, "below", "half", below, 2) == CSGRT_OK);
        EXPECT(csgrt_scene_add_combination(scene, &peg) == CSGRT_OK);
        EXPECT(csgrt_scene_add_combination(scene, &ground) == CSGRT_OK);
        csgrt_model_free(next);
        EXPECT(csgrt_model_create(scene, NULL, 0, NULL, &next) == CSGRT_OK);
        EXPECT(csgrt_checker_create(next, NULL, &checker) == CSGRT_OK);
        EXPECT(csgrt_checker_check(checker, NULL, &result) == CSGRT_OK);
        EXPECT(result.overlaps == 1 && result.new_overlaps == 1 && result.is_complete && result.rays > 0);
        EXPECT(result.unbounded == 1 && result.unused == 0 && result.unlisted == 2);
        EXPECT(csgrt_checker_unlisted(checker, 0, &pair) == CSGRT_OK && pair.regions[1] == 2 && !pair.is_seen);
        EXPECT(csgrt_checker_unbounded(checker, 0, &open_region) == CSGRT_OK && open_region == 2);
        EXPECT(csgrt_checker_overlap(checker, 0, &overlap) == CSGRT_OK);
        EXPECT(overlap.regions[0] == 0 && overlap.regions[1] == 1 && overlap.is_new && !overlap.is_allowed);
        EXPECT(overlap.depth > 0.45 && overlap.depth <= overlap.depth_at_most && overlap.volume.value > 15);
        squared = overlap.place.x * overlap.place.x + overlap.place.y * overlap.place.y;
        EXPECT(squared > 3.1 * 3.1 && squared < 3.4 * 3.4 && overlap.place.z > 1 && overlap.place.z < 3);
        EXPECT(overlap.box.low.z > 0.999 && overlap.box.high.z < 3.001 && overlap.t_out > overlap.t_in);
        EXPECT(csgrt_checker_overlap(checker, 1, &overlap) == CSGRT_ERROR_USAGE);
        request.allowed = rows;
        request.allowed_count = 2;
        EXPECT(csgrt_checker_check(checker, &request, &result) == CSGRT_OK);
        EXPECT(csgrt_checker_overlap(checker, 0, &overlap) == CSGRT_OK && overlap.is_allowed && !overlap.is_new);
        EXPECT(result.new_overlaps == 0 && result.unused == 1);
        EXPECT(csgrt_checker_unused(checker, 0, &unused) == CSGRT_OK && strcmp(unused.second, "/ground") == 0);
        EXPECT(csgrt_checker_load_allowed(checker, "/nowhere") == CSGRT_ERROR_FILE);
        request.min_depth = 0;
        EXPECT(csgrt_checker_check(checker, &request, &result) == CSGRT_ERROR_USAGE);
        csgrt_checker_free(checker);
        settings.progress = end_at_once;
        EXPECT(csgrt_checker_create(next, &settings, &checker) == CSGRT_OK);
        EXPECT(csgrt_checker_check(checker, NULL, &result) == CSGRT_OK && !result.is_complete);
    }

    csgrt_checker_free(checker);
    csgrt_measurer_free(measurer);
    csgrt_verifier_free(verifier);
    csgrt_edit_free(edit);
    csgrt_image_free(image);
    csgrt_renderer_free(renderer);
    csgrt_model_free(next);
    csgrt_model_free(model);
    csgrt_scene_free(scene);
    printf("csgrt %s in C\n", csgrt_version());
    return 0;
}
