// What lies along one ray, by librt's names, as BRL-CAD's rtexample prints it. For librt itself only the includes
// differ.
//     librt_partitions MODEL OBJECT... X Y Z DX DY DZ
#include <stdlib.h>

#include <csgrt/librt.h>

static int print_hit(struct application* ap, struct partition* head, struct seg* UNUSED(segs)) {
    struct partition* pp;
    for (pp = head->pt_forw; pp != head; pp = pp->pt_forw) {
        struct hit* hitp = pp->pt_inhit;
        struct soltab* stp = pp->pt_inseg->seg_stp;
        point_t point;
        vect_t normal;

        bu_log("%s from %g (%s) to %g (%s)\n", pp->pt_regionp->reg_name, hitp->hit_dist, stp->st_name,
               pp->pt_outhit->hit_dist, pp->pt_outseg->seg_stp->st_name);
        rt_pr_hit("  In", hitp);
        VJOIN1(point, ap->a_ray.r_pt, hitp->hit_dist, ap->a_ray.r_dir);
        VPRINT("  at", point);
        RT_HIT_NORMAL(normal, hitp, stp, &ap->a_ray, pp->pt_inflip);
        VPRINT("  normal", normal);

        hitp = pp->pt_outhit;
        stp = pp->pt_outseg->seg_stp;
        RT_HIT_NORMAL(normal, hitp, stp, &ap->a_ray, pp->pt_outflip);
        rt_pr_hit("  Out", hitp);
        VPRINT("  normal", normal);
    }
    return 1;
}

static int print_miss(struct application* UNUSED(ap)) {
    bu_log("the ray meets nothing\n");
    return 0;
}

static int print_overlap(struct application* UNUSED(ap), struct partition* pp, struct region* one, struct region* other,
                         struct partition* UNUSED(head)) {
    bu_log("%s and %s overlap from %g to %g\n", one->reg_name, other->reg_name, pp->pt_inhit->hit_dist,
           pp->pt_outhit->hit_dist);
    return 1; /* the first gets it */
}

int main(int argc, char** argv) {
    struct application ap;
    struct rt_i* rtip = RTI_NULL;
    char title[100] = {0};
    int i;

    if (argc < 9) bu_exit(2, "usage: %s MODEL OBJECT... X Y Z DX DY DZ\n", argv[0]);
    rtip = rt_dirbuild(argv[1], title, sizeof(title));
    if (rtip == RTI_NULL) bu_exit(3, NULL);
    for (i = 2; i < argc - 6; ++i)
        if (rt_gettree(rtip, argv[i]) < 0) bu_log("%s is left out\n", argv[i]);
    rt_prep_parallel(rtip, 1);
    bu_log("%s: %d regions\n", title, (int)rtip->nregions);

    RT_APPLICATION_INIT(&ap);
    ap.a_rt_i = rtip;
    ap.a_onehit = 0;
    ap.a_hit = print_hit;
    ap.a_miss = print_miss;
    ap.a_overlap = print_overlap;
    for (i = 0; i < 3; ++i) {
        ap.a_ray.r_pt[i] = atof(argv[argc - 6 + i]);
        ap.a_ray.r_dir[i] = atof(argv[argc - 3 + i]);
    }
    VUNITIZE(ap.a_ray.r_dir);
    VPRINT("Pnt", ap.a_ray.r_pt);
    VPRINT("Dir", ap.a_ray.r_dir);
    rt_shootray(&ap);
    rt_free_rti(rtip);
    return 0;
}
