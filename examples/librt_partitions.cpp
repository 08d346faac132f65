// What lies along one ray, by librt's names, as BRL-CAD's rtexample prints it:
//     librt_partitions MODEL OBJECT... X Y Z DX DY DZ
#include <cstdio>
#include <cstdlib>

#include <csgrt/librt.h>

static int print(application* ap, partition* head, seg*) {
    for (partition* p = head->pt_forw; p != head; p = p->pt_forw) {
        point_t in;
        vect_t normal;
        VJOIN1(in, ap->a_ray.r_pt, p->pt_inhit->hit_dist, ap->a_ray.r_dir);
        RT_HIT_NORMAL(normal, p->pt_inhit, p->pt_inseg->seg_stp, &ap->a_ray, p->pt_inflip);
        std::printf("%s from %g (%s) to %g (%s), enters at %g %g %g with normal %g %g %g\n", p->pt_regionp->reg_name,
                    p->pt_inhit->hit_dist, p->pt_inseg->seg_stp->st_name, p->pt_outhit->hit_dist,
                    p->pt_outseg->seg_stp->st_name, in[X], in[Y], in[Z], normal[X], normal[Y], normal[Z]);
    }
    return 1;
}

static int print_miss(application*) {
    std::puts("the ray meets nothing");
    return 0;
}

static int print_overlap(application*, partition* p, region* one, region* other, partition*) {
    std::printf("%s and %s overlap from %g to %g\n", one->reg_name, other->reg_name, p->pt_inhit->hit_dist,
                p->pt_outhit->hit_dist);
    return 1;  // the first gets it
}

int main(int count, const char** words) {
    if (count < 8) {
        std::fprintf(stderr, "usage: %s MODEL OBJECT... X Y Z DX DY DZ\n", words[0]);
        return 2;
    }
    char title[100] = {};
    rt_i* rtip = rt_dirbuild(words[1], title, sizeof title);
    if (rtip == RTI_NULL || rt_gettrees(rtip, count - 8, words + 2, 1) < 0) return 3;
    rt_prep_parallel(rtip, 1);
    std::printf("%s: %zu regions\n", title, rtip->nregions);

    application ap;
    RT_APPLICATION_INIT(&ap);
    ap.a_rt_i = rtip;
    ap.a_hit = print;
    ap.a_miss = print_miss;
    ap.a_overlap = print_overlap;
    const char** at = words + count - 6;
    VSET(ap.a_ray.r_pt, std::atof(at[0]), std::atof(at[1]), std::atof(at[2]));
    VSET(ap.a_ray.r_dir, std::atof(at[3]), std::atof(at[4]), std::atof(at[5]));
    rt_shootray(&ap);
    rt_free_rti(rtip);
}
