// Prints everything along a ray through a scene: each region, where the ray enters it, where it leaves it, and how thick
// it is there.
//
//     partitions SCENE X Y Z DX DY DZ
#include <csgrt/csgrt.h>

#include <stdio.h>
#include <stdlib.h>

static int failed(csgrt_status status) {
    if (status != CSGRT_OK) fprintf(stderr, "%s\n", csgrt_last_error());
    return status != CSGRT_OK;
}

static void print(const csgrt_model* model, const csgrt_partitions* partitions) {
    csgrt_partition_arrays rows = CSGRT_PARTITION_ARRAYS;
    if (failed(csgrt_partitions_get(partitions, &rows))) return;
    for (size_t row = 0; row < rows.row_count; ++row) {  // of several rays, ray i has ray_splits[i] to ray_splits[i + 1]
        csgrt_region_info region = CSGRT_REGION_INFO;
        if (failed(csgrt_model_region(model, (size_t)rows.region_ids[row], &region))) return;
        const double in = rows.t_in[row], out = rows.t_out[row];
        printf("%-30s %12.4f %12.4f %12.4f\n", region.path, in, out, out - in);
    }
}

int main(int argc, char** argv) {
    if (argc != 8) {
        fprintf(stderr, "usage: partitions SCENE X Y Z DX DY DZ\n");
        return 2;
    }
    double numbers[6];
    for (int i = 0; i < 6; ++i) numbers[i] = atof(argv[i + 2]);
    const csgrt_ray ray = {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
    csgrt_rays rays = CSGRT_RAYS;
    rays.list = &ray;
    rays.count = 1;

    csgrt_scene* scene = NULL;
    csgrt_model* model = NULL;
    csgrt_partitions* partitions = NULL;
    // What is made once and used for all rays: the model, and the memory of the answers.
    const int is_bad = failed(csgrt_load_scene(argv[1], NULL, &scene)) ||
                       failed(csgrt_model_create(scene, NULL, 0, NULL, &model)) ||
                       failed(csgrt_partitions_create(&partitions)) ||
                       failed(csgrt_model_partitions(model, &rays, partitions));
    if (!is_bad) print(model, partitions);

    csgrt_partitions_free(partitions);
    csgrt_model_free(model);
    csgrt_scene_free(scene);
    return is_bad;
}
