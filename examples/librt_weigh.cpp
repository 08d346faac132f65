// Volumes of regions by a grid of rays, by librt's names, as BRL-CAD's rtweight and gqa find them:
//     librt_weigh MODEL [OBJECT...]
#include <cmath>
#include <cstdio>
#include <vector>

#include <csgrt/librt.h>

static int add(application* ap, partition* head, seg*) {
    auto& lengths = *static_cast<std::vector<double>*>(ap->a_uptr);
    for (partition* p = head->pt_forw; p != head; p = p->pt_forw)
        lengths[static_cast<std::size_t>(p->pt_regionp->reg_bit)] += p->pt_outhit->hit_dist - p->pt_inhit->hit_dist;
    return 1;
}

int main(int count, const char** words) {
    if (count < 2) {
        std::fprintf(stderr, "usage: %s MODEL [OBJECT...]\n", words[0]);
        return 2;
    }
    rt_i* rtip = rt_dirbuild(words[1], nullptr, 0);
    if (rtip == RTI_NULL || rt_gettrees(rtip, count - 2, words + 2, 1) < 0) return 3;
    rt_prep_parallel(rtip, 0);
    std::vector<double> lengths(rtip->nregions);
    application ap;
    ap.a_rt_i = rtip;
    ap.a_hit = add;
    ap.a_uptr = &lengths;

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
    std::printf("%zu of %zu rays hit\n", hits, rays.size());
    for (std::size_t i = 0; i < lengths.size(); ++i)
        std::printf("%-40s material %d: %.4g mm^3\n", rtip->Regions[i]->reg_name, rtip->Regions[i]->reg_gmater,
                    lengths[i] * x * y);
    rt_free_rti(rtip);
}
