// Every name that docs/librt.md says is there, used as BRL-CAD's programs use it. there_test.cmake compiles it.
#include <csgrt/librt.h>

static int on_hit(struct application* ap, struct partition* head, struct seg* UNUSED(segs)) {
    struct partition* pp;
    RT_CK_AP(ap);
    for (pp = head->pt_forw; pp != head; pp = pp->pt_forw) {
        struct hit* hitp = pp->pt_inhit;
        struct soltab* stp = pp->pt_inseg->seg_stp;
        const struct region* reg = pp->pt_regionp;
        RT_HIT_NORMAL(hitp->hit_normal, hitp, stp, 0, pp->pt_inflip);
        VJOIN1(hitp->hit_point, ap->a_ray.r_pt, hitp->hit_dist, ap->a_ray.r_dir);
        rt_pr_hit(stp->st_name, hitp);
        bu_log("%s %d %d %d %d %g\n", reg->reg_name, reg->reg_regionid, reg->reg_gmater, reg->reg_los, reg->reg_aircode,
               reg->reg_mater.ma_color[0]);
    }
    return ap->a_return;
}

static int on_miss(struct application* ap) { return ap->a_user; }

static int on_overlap(struct application* UNUSED(ap), struct partition* UNUSED(pp), struct region* UNUSED(one),
                      struct region* UNUSED(other), struct partition* UNUSED(head)) {
    return 1;
}

static void on_regions(struct application* UNUSED(ap), struct partition* UNUSED(pp), struct bu_ptbl* table,
                       struct partition* UNUSED(head)) {
    struct region** rpp;
    for (BU_PTBL_FOR(rpp, (struct region**), table)) bu_log("%s\n", (*rpp)->reg_name);
    for (size_t i = 0; i < BU_PTBL_LEN(table); ++i)
        bu_log("%s\n", reinterpret_cast<region*>(BU_PTBL_GET(table, i))->reg_name);
    bu_ptbl_reset(table);
}

static void vectors(void) {
    point_t a;
    vect_t b, c;
    VSET(a, 1, 2, 3);
    VSETALL(b, 1);
    VMOVE(c, a);
    VREVERSE(c, a);
    VJOIN1(c, a, 2, b);
    VBLEND2(c, 0.5, a, 0.5, b);
    VADD2(c, a, b);
    VSUB2(c, a, b);
    VSCALE(c, a, VDOT(a, b));
    VCROSS(c, a, b);
    VUNITIZE(c);
    bu_log("%g %g %g %g %g\n", V3ARGS(a), MAGSQ(a), MAGNITUDE(b));
    VPRINT("c", c);
    a[X] = a[Y] = a[Z];
}

static void models(const char* file, const char** names) {
    struct rt_i* rtip = rt_dirbuild(file, NULL, 0);
    struct resource* resp = static_cast<resource*>(bu_calloc(1, sizeof(resource), "resource"));
    struct region* rp;
    struct application ap, *other;
    fastf_t* numbers = (fastf_t*)bu_malloc(3 * sizeof(fastf_t), "numbers");
    if (!rtip) bu_exit(1, NULL);
    rtip->useair = 1;
    if (rt_gettree(rtip, names[0]) < 0 || rt_gettrees(rtip, 1, names, 1) < 0 || rtip->nsolids < 1) bu_bomb("none");
    rt_prep_parallel(rtip, 1);
    if (rtip->needprep) rt_prep(rtip);
    rt_init_resource(resp, 0, rtip);
    for (BU_LIST_FOR(rp, region, &(rtip->HeadRegion))) rp->reg_udata = NULL;
    for (size_t i = 0; i < rtip->nregions; ++i) rtip->Regions[i]->reg_udata = NULL;
    VMOVE(numbers, rtip->mdl_min);
    VMOVE(numbers, rtip->mdl_max);
    bu_log("%s %g\n", rtip->rti_dbip->dbi_title, rtip->rti_dbip->dbi_base2local);

    RT_APPLICATION_INIT(&ap);
    ap.a_rt_i = rtip;
    ap.a_hit = on_hit;
    ap.a_miss = on_miss;
    ap.a_overlap = on_overlap;
    ap.a_multioverlap = on_regions;
    ap.a_logoverlap = rt_silent_logoverlap;
    ap.a_resource = &rt_uniresource;
    ap.a_onehit = 0;
    ap.a_uptr = NULL;
    VSET(ap.a_ray.r_dir, 0, 0, 1);
    bu_semaphore_acquire(BU_SEM_SYSCALL);
    BU_ALLOC(other, struct application);
    bu_semaphore_release(BU_SEM_SYSCALL);
    (void)rt_shootray(&ap);
    bu_log("%g\n", other->a_dist);
    bu_free(other, "application");
    rt_clean(rtip);
    rt_clean_resource_complete(0, resp);
    rt_free_rti(rtip);
}

int main(int, const char** words) {
    vectors();
    models(words[1], words + 2);
}
