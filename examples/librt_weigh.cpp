// Volumes and centroids of regions by a grid of rays, by librt's names: the callbacks and the list of regions are used
// as BRL-CAD's rtweight uses them, and for librt itself only the includes differ. `csgrt::librt::shoot_many` is
// csgrt's: it traces all rays at once.
//     librt_weigh MODEL [OBJECT...]
#include <vector>

#include <csgrt/librt.h>

struct sum {
    fastf_t length;
    vect_t moment;
};

static int overlaps = 0;

static int add(struct application* ap, struct partition* head, struct seg* UNUSED(segs)) {
    struct partition* pp;
    struct xray* rp = &ap->a_ray;

    for (pp = head->pt_forw; pp != head; pp = pp->pt_forw) {
        struct region* reg = pp->pt_regionp;
        struct hit* ihitp = pp->pt_inhit;
        struct hit* ohitp = pp->pt_outhit;
        struct sum* sum;
        fastf_t depth;
        vect_t middle;

        if (reg->reg_aircode) continue;
        VJOIN1(ihitp->hit_point, rp->r_pt, ihitp->hit_dist, rp->r_dir);
        VJOIN1(ohitp->hit_point, rp->r_pt, ohitp->hit_dist, rp->r_dir);
        depth = ohitp->hit_dist - ihitp->hit_dist;
        VBLEND2(middle, 0.5, ihitp->hit_point, 0.5, ohitp->hit_point);
        VSCALE(middle, middle, depth);

        bu_semaphore_acquire(BU_SEM_SYSCALL);
        if (!reg->reg_udata) {
            BU_ALLOC(sum, struct sum);
            reg->reg_udata = (void*)sum;
        }
        sum = (struct sum*)reg->reg_udata;
        sum->length += depth;
        VADD2(sum->moment, sum->moment, middle);
        bu_semaphore_release(BU_SEM_SYSCALL);
    }
    return 1;
}

static int overlap(struct application* UNUSED(ap), struct partition* UNUSED(pp), struct region* UNUSED(reg1),
                   struct region* UNUSED(reg2), struct partition* UNUSED(hp)) {
    bu_semaphore_acquire(BU_SEM_SYSCALL);
    overlaps++;
    bu_semaphore_release(BU_SEM_SYSCALL);
    return 1;
}

int main(int count, const char** words) {
    struct application ap;
    struct region* rp;
    struct rt_i* rtip;

    if (count < 2) bu_exit(2, "usage: %s MODEL [OBJECT...]\n", words[0]);
    rtip = rt_dirbuild(words[1], NULL, 0);
    if (rtip == RTI_NULL || rt_gettrees(rtip, count - 2, words + 2, 1) < 0) bu_exit(3, NULL);
    rt_prep_parallel(rtip, 0);
    for (BU_LIST_FOR(rp, region, &(rtip->HeadRegion))) rp->reg_udata = NULL;
    RT_APPLICATION_INIT(&ap);
    ap.a_rt_i = rtip;
    ap.a_hit = add;
    ap.a_overlap = overlap;

    // Rays along z through the middles of a grid's cells.
    const int cells = 500;
    const double x = (rtip->mdl_max[X] - rtip->mdl_min[X]) / cells, y = (rtip->mdl_max[Y] - rtip->mdl_min[Y]) / cells;
    std::vector<xray> rays;
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            xray ray;
            VSET(ray.r_pt, rtip->mdl_min[X] + (column + 0.5) * x, rtip->mdl_min[Y] + (row + 0.5) * y,
                 rtip->mdl_min[Z] - 1);
            VSET(ray.r_dir, 0, 0, 1);
            rays.push_back(ray);
        }
    const std::size_t hits = csgrt::librt::shoot_many(&ap, rays.data(), rays.size());
    std::printf("%zu of %zu rays hit, %d overlaps\n", hits, rays.size(), overlaps);
    for (BU_LIST_FOR(rp, region, &(rtip->HeadRegion))) {
        struct sum* sum = (struct sum*)rp->reg_udata;
        if (!sum) continue;
        VSCALE(sum->moment, sum->moment, 1 / sum->length);
        std::printf("%-40s material %d: %.4g mm^3, centroid %.4g %.4g %.4g\n", rp->reg_name, rp->reg_gmater,
                    sum->length * x * y, V3ARGS(sum->moment));
        bu_free(sum, "sum");
    }
    rt_free_rti(rtip);
}
