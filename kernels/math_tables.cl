/* math_tables.cl - the numbers of math.cl. Made by math_tables.py. */
#ifdef VECTOR
#define TABLE(type, name, count) __constant type name[count]
#endif

/* ln 2: the first has 40 bits */
#define LN2_0 0x1.62e42fefa2000p-1
#define LN2_1 0x1.9ef35793c7673p-41
#define LN2_2 0x1.f97b57a079a19p-103

/* pi / 2 */
#define HALF_PI_0 0x1.921fb54442d18p+0
#define HALF_PI_1 0x1.1a62633145c07p-54
#define HALF_PI_2 -0x1.f1976b7ed8fbcp-110

/* pi */
#define PI_0 0x1.921fb54442d18p+1
#define PI_1 0x1.1a62633145c07p-53
#define PI_2 -0x1.f1976b7ed8fbcp-109

/* 1 / ln 2 */
#define INVERSE_LN2_0 0x1.71547652b82fep+0
#define INVERSE_LN2_1 0x1.777d0ffda0d24p-56
#define INVERSE_LN2_2 -0x1.60bb8a5442ab9p-110

/* 1 / ln 10 */
#define INVERSE_LN10_0 0x1.bcb7b1526e50ep-2
#define INVERSE_LN10_1 0x1.95355baaafad3p-57
#define INVERSE_LN10_2 0x1.ee191f71a3012p-112

/* 2 / pi */
#define TWO_OVER_PI_0 0x1.45f306dc9c883p-1
#define TWO_OVER_PI_1 -0x1.6b01ec5417056p-55
#define TWO_OVER_PI_2 -0x1.6447e493ad4cep-109

/* e^r = 1 + r + r^2 EXP(r); off by 1.7e-20 at most */
#define EXP_0 0x1.0000000000000p-1
#define EXP_1 0x1.5555555555555p-3
#define EXP_2 0x1.5555555555557p-5
#define EXP_3 0x1.1111111111111p-7
#define EXP_4 0x1.6c16c16c15a3fp-10
#define EXP_5 0x1.a01a01a019696p-13
#define EXP_6 0x1.a01a01a9faa85p-16
#define EXP_7 0x1.71de3a5ab0d80p-19
#define EXP_8 0x1.27e4d3ebbbbb4p-22
#define EXP_9 0x1.ae642c522f57ep-26
#define EXP_10 0x1.1f7f7bd858cc6p-29
#define EXP_11 0x1.61c0041f196cep-33

/* ln(1 + r) = r - r^2/2 + r^3 LOG(r); off by 8.0e-22 at most */
#define LOG_0 0x1.5555555555555p-2
#define LOG_1 -0x1.0000000000000p-2
#define LOG_2 0x1.99999999999b6p-3
#define LOG_3 -0x1.555555555556fp-3
#define LOG_4 0x1.24924920731a2p-3
#define LOG_5 -0x1.fffffff8717edp-4
#define LOG_6 0x1.c722a38f25be7p-4
#define LOG_7 -0x1.999f473bd0e4bp-4

/* sin r = r + r^3 SIN(r^2); off by 5.2e-24 at most */
#define SIN_0 -0x1.5555555555555p-3
#define SIN_1 0x1.1111111111111p-7
#define SIN_2 -0x1.a01a01a01a019p-13
#define SIN_3 0x1.71de3a556c2c7p-19
#define SIN_4 -0x1.ae64567e72e9ap-26
#define SIN_5 0x1.61245fb4bee94p-33
#define SIN_6 -0x1.ae7c5370664f0p-41
#define SIN_7 0x1.92428e5825432p-49

/* cos r = 1 - r^2/2 + r^4 COS(r^2); off by 2.6e-25 at most */
#define COS_0 0x1.5555555555555p-5
#define COS_1 -0x1.6c16c16c16c17p-10
#define COS_2 0x1.a01a01a01a019p-16
#define COS_3 -0x1.27e4fb7789d97p-22
#define COS_4 0x1.1eed8eff3355bp-29
#define COS_5 -0x1.939749540f022p-37
#define COS_6 0x1.ae7ce896ed655p-45
#define COS_7 -0x1.65d29bad11334p-53

/* sinh r = r + r^3 SINH(r^2); off by 2.1e-23 at most */
#define SINH_0 0x1.5555555555555p-3
#define SINH_1 0x1.1111111111111p-7
#define SINH_2 0x1.a01a01a01a02dp-13
#define SINH_3 0x1.71de3a5565267p-19
#define SINH_4 0x1.ae6456a905711p-26
#define SINH_5 0x1.6123e702c4c41p-33
#define SINH_6 0x1.afe276e54df69p-41

/* cosh r = 1 + r^2/2 + r^4 COSH(r^2); off by 1.2e-24 at most */
#define COSH_0 0x1.5555555555555p-5
#define COSH_1 0x1.6c16c16c16c17p-10
#define COSH_2 0x1.a01a01a01a023p-16
#define COSH_3 0x1.27e4fb7786b76p-22
#define COSH_4 0x1.1eed8f12140f8p-29
#define COSH_5 0x1.9396ddee6be3ep-37
#define COSH_6 0x1.afbaf2481e086p-45

/* atan r = r + r^3 ATAN(r^2); off by 3.1e-23 at most */
#define ATAN_0 -0x1.5555555555555p-2
#define ATAN_1 0x1.999999999999ap-3
#define ATAN_2 -0x1.24924924920e2p-3
#define ATAN_3 0x1.c71c71bf59c90p-4
#define ATAN_4 -0x1.745cdc346d5f0p-4
#define ATAN_5 0x1.3a4469f276b7bp-4

/* 1/c as a double, and the logarithm of that double's inverse, for c = (i + 90) / 128 */
TABLE(double, log_table, 276) = {
    0x1.6c16c16c16c17p+0,
    -0x1.68ac83e9c6a15p-2,
    0x1.acd8a9145ff44p-57,
    0x1.6816816816817p+0,
    -0x1.5d5bddf595f31p-2,
    -0x1.d5f75b9a23ae4p-59,
    0x1.642c8590b2164p+0,
    -0x1.522ae0738a3d7p-2,
    -0x1.3840b263acb43p-56,
    0x1.6058160581606p+0,
    -0x1.4718dc271c41cp-2,
    -0x1.d8fb4c14c56eep-56,
    0x1.5c9882b931057p+0,
    -0x1.3c25277333183p-2,
    -0x1.152d81af5713ap-56,
    0x1.58ed2308158edp+0,
    -0x1.314f1e1d35ce3p-2,
    -0x1.22966f61a3c23p-56,
    0x1.5555555555555p+0,
    -0x1.269621134db91p-2,
    -0x1.e0efadd9db02ap-56,
    0x1.51d07eae2f815p+0,
    -0x1.1bf99635a6b95p-2,
    0x1.e9575c2124912p-56,
    0x1.4e5e0a72f0539p+0,
    -0x1.1178e8227e47ap-2,
    -0x1.b8ce2d07f1cb7p-56,
    0x1.4afd6a052bf5bp+0,
    -0x1.07138604d5864p-2,
    0x1.24e912b16ec8bp-60,
    0x1.47ae147ae147bp+0,
    -0x1.f991c6cb3b37ap-3,
    -0x1.ecca0cdf30143p-58,
    0x1.446f86562d9fbp+0,
    -0x1.e530effe71013p-3,
    0x1.f7627ef82f3f0p-57,
    0x1.4141414141414p+0,
    -0x1.d1037f2655e7bp-3,
    0x1.3f3adb7b71cbcp-58,
    0x1.3e22cbce4a902p+0,
    -0x1.bd087383bd8aap-3,
    0x1.1165504ad749ep-59,
    0x1.3b13b13b13b14p+0,
    -0x1.a93ed3c8ad9e5p-3,
    -0x1.bcafa9de97202p-57,
    0x1.3813813813814p+0,
    -0x1.95a5adcf70182p-3,
    -0x1.8a16283fdbd1cp-57,
    0x1.3521cfb2b78c1p+0,
    -0x1.823c16551a3c0p-3,
    -0x1.6dcd318f4187ep-57,
    0x1.323e34a2b10bfp+0,
    -0x1.6f0128b756ab9p-3,
    0x1.37967087859b9p-59,
    0x1.2f684bda12f68p+0,
    -0x1.5bf406b543db0p-3,
    0x1.1f5b44c0df7f7p-61,
    0x1.2c9fb4d812ca0p+0,
    -0x1.4913d8333b563p-3,
    0x1.0d5604930f137p-58,
    0x1.29e4129e4129ep+0,
    -0x1.365fcb0159014p-3,
    -0x1.bea08d2dca256p-57,
    0x1.27350b8812735p+0,
    -0x1.23d712a49c201p-3,
    -0x1.51c7e9efae297p-57,
    0x1.2492492492492p+0,
    -0x1.1178e8227e47ap-3,
    0x1.0e63a5f01c693p-58,
    0x1.21fb78121fb78p+0,
    -0x1.fe89139dbd565p-4,
    0x1.ac9f4215f9394p-58,
    0x1.1f7047dc11f70p+0,
    -0x1.da7276384469ep-4,
    -0x1.401fa71733017p-58,
    0x1.1cf06ada2811dp+0,
    -0x1.b6ac88dad5b1dp-4,
    0x1.002bf768e52d0p-58,
    0x1.1a7b9611a7b96p+0,
    -0x1.9335e5d594988p-4,
    0x1.478a85704ccb7p-58,
    0x1.1811811811812p+0,
    -0x1.700d30aeac0e8p-4,
    -0x1.a36a677b4c8b2p-59,
    0x1.15b1e5f75270dp+0,
    -0x1.4d3115d207eacp-4,
    -0x1.da7d0b1e10b2fp-60,
    0x1.135c81135c811p+0,
    -0x1.2aa04a44717a1p-4,
    -0x1.aea2c72d05c08p-58,
    0x1.1111111111111p+0,
    -0x1.08598b59e3a06p-4,
    0x1.dd7009902bf32p-58,
    0x1.0ecf56be69c90p+0,
    -0x1.ccb73cdddb2d0p-5,
    0x1.e48fb0500efd5p-59,
    0x1.0c9714fbcda3bp+0,
    -0x1.894aa149fb34bp-5,
    0x1.2ba0b44cfaee5p-59,
    0x1.0a6810a6810a7p+0,
    -0x1.466aed42de3f9p-5,
    0x1.9badefe942718p-60,
    0x1.0842108421084p+0,
    -0x1.0415d89e74440p-5,
    -0x1.c05cf1d753621p-59,
    0x1.0624dd2f1a9fcp+0,
    -0x1.8492528c8cac5p-6,
    0x1.d192d0619fa68p-60,
    0x1.0410410410410p+0,
    -0x1.0205658935837p-6,
    -0x1.27c8e8416e717p-60,
    0x1.0204081020408p+0,
    -0x1.010157588de69p-7,
    -0x1.46662d417cecep-62,
    0x1.0000000000000p+0,
    0x0.0p+0,
    0x0.0p+0,
    0x1.fc07f01fc07f0p-1,
    0x1.fe02a6b106799p-8,
    -0x1.e44b7e3711e7fp-67,
    0x1.f81f81f81f820p-1,
    0x1.fc0a8b0fc03c4p-7,
    -0x1.83092c5964281p-62,
    0x1.f44659e4a4271p-1,
    0x1.7b91b07d5b126p-6,
    -0x1.6d80ab38e9430p-62,
    0x1.f07c1f07c1f08p-1,
    0x1.f829b0e7832f8p-6,
    0x1.33e3f04f1ef25p-60,
    0x1.ecc07b301ecc0p-1,
    0x1.39e87b9febd68p-5,
    -0x1.5bfa937f551b7p-59,
    0x1.e9131abf0b767p-1,
    0x1.77458f632dcffp-5,
    0x1.8d3ca87b92968p-63,
    0x1.e573ac901e574p-1,
    0x1.b42dd711971b9p-5,
    0x1.0a34531f67db5p-59,
    0x1.e1e1e1e1e1e1ep-1,
    0x1.f0a30c01162a8p-5,
    0x1.85f325c5bbacdp-59,
    0x1.de5d6e3f8868ap-1,
    0x1.16536eea37ae3p-4,
    0x1.2189705cf74cap-58,
    0x1.dae6076b981dbp-1,
    0x1.341d7961bd1d0p-4,
    -0x1.3599f227becbbp-58,
    0x1.d77b654b82c34p-1,
    0x1.51b073f06183cp-4,
    -0x1.5b61c65e5741ap-58,
    0x1.d41d41d41d41dp-1,
    0x1.6f0d28ae56b4ep-4,
    -0x1.20db323097324p-59,
    0x1.d0cb58f6ec074p-1,
    0x1.8c345d6319b23p-4,
    -0x1.294d2f5668495p-58,
    0x1.cd85689039b0bp-1,
    0x1.a926d3a4ad562p-4,
    -0x1.d7a16eab1e2adp-59,
    0x1.ca4b3055ee191p-1,
    0x1.c5e548f5bc743p-4,
    0x1.2eb0bf7c0b0d9p-59,
    0x1.c71c71c71c71cp-1,
    0x1.e27076e2af2eap-4,
    -0x1.61578001e015ap-60,
    0x1.c3f8f01c3f8f0p-1,
    0x1.fec9131dbeabcp-4,
    -0x1.5746b9981b36cp-58,
    0x1.c0e070381c0e0p-1,
    0x1.0d77e7cd08e5bp-3,
    0x1.9a5dc5e9030adp-57,
    0x1.bdd2b899406f7p-1,
    0x1.1b72ad52f67a2p-3,
    -0x1.fbe7ee5c69946p-57,
    0x1.bacf914c1bad0p-1,
    0x1.29552f81ff521p-3,
    0x1.301771c407dc0p-57,
    0x1.b7d6c3dda338bp-1,
    0x1.371fc201e8f75p-3,
    0x1.e6cb62af18a02p-62,
    0x1.b4e81b4e81b4fp-1,
    0x1.44d2b6ccb7d1cp-3,
    0x1.7d3d950f87e23p-59,
    0x1.b2036406c80d9p-1,
    0x1.526e5e3a1b438p-3,
    -0x1.546ff8a470d3ap-57,
    0x1.af286bca1af28p-1,
    0x1.5ff3070a793d6p-3,
    -0x1.bc60efafc6f6cp-58,
    0x1.ac5701ac5701bp-1,
    0x1.6d60fe719d21bp-3,
    0x1.d551d97132e87p-57,
    0x1.a98ef606a63bep-1,
    0x1.7ab890210d907p-3,
    -0x1.1072534a57e7dp-57,
    0x1.a6d01a6d01a6dp-1,
    0x1.87fa06520c911p-3,
    -0x1.9f7fdbfa08d9ap-57,
    0x1.a41a41a41a41ap-1,
    0x1.9525a9cf456b6p-3,
    -0x1.26fb3e2b1d1dap-57,
    0x1.a16d3f97a4b02p-1,
    0x1.a23bc1fe2b561p-3,
    0x1.24dc46c1ea664p-57,
    0x1.9ec8e951033d9p-1,
    0x1.af3c94e80bff3p-3,
    0x1.a3398064df33ep-57,
    0x1.9c2d14ee4a102p-1,
    0x1.bc286742d8cd4p-3,
    0x1.cfce744870f57p-58,
    0x1.999999999999ap-1,
    0x1.c8ff7c79a9a20p-3,
    -0x1.4f689f8434011p-57,
    0x1.970e4f80cb872p-1,
    0x1.d5c216b4fbb94p-3,
    -0x1.a37794d03657dp-58,
    0x1.948b0fcd6e9e0p-1,
    0x1.e27076e2af2e8p-3,
    -0x1.61578001e015ep-59,
    0x1.920fb49d0e229p-1,
    0x1.ef0adcbdc5935p-3,
    0x1.e8637950dc20dp-57,
    0x1.8f9c18f9c18fap-1,
    0x1.fb9186d5e3e29p-3,
    0x1.355519b0de535p-57,
    0x1.8d3018d3018d3p-1,
    0x1.0402594b4d041p-2,
    -0x1.08ec217a5022dp-57,
    0x1.8acb90f6bf3aap-1,
    0x1.0a324e27390e2p-2,
    0x1.bdcfde8061c03p-56,
    0x1.886e5f0abb04ap-1,
    0x1.1058bf9ae4ad4p-2,
    0x1.3f415699663ecp-63,
    0x1.8618618618618p-1,
    0x1.1675cababa60fp-2,
    0x1.ce63eab883727p-61,
    0x1.83c977ab2beddp-1,
    0x1.1c898c16999fbp-2,
    0x1.9f1a39d500e3cp-56,
    0x1.8181818181818p-1,
    0x1.22941fbcf7966p-2,
    -0x1.dbd7ac258a2bdp-58,
    0x1.7f405fd017f40p-1,
    0x1.2895a13de86a4p-2,
    0x1.7ad24c13f040fp-56,
    0x1.7d05f417d05f4p-1,
    0x1.2e8e2bae11d31p-2,
    -0x1.1e99b72bd7bf2p-57,
    0x1.7ad2208e0ecc3p-1,
    0x1.347dd9a987d56p-2,
    -0x1.16ea62c048cfbp-56,
    0x1.78a4c8178a4c8p-1,
    0x1.3a64c556945eap-2,
    0x1.cbcd735d03424p-60,
    0x1.767dce434a9b1p-1,
    0x1.404308686a7e4p-2,
    -0x1.f79f6c1059cdbp-57,
    0x1.745d1745d1746p-1,
    0x1.4618bc21c5ec2p-2,
    -0x1.7a42642661c62p-61,
    0x1.724287f46debcp-1,
    0x1.4be5f957778a1p-2,
    -0x1.4b366b609027ap-58,
    0x1.702e05c0b8170p-1,
    0x1.51aad872df82ep-2,
    -0x1.d8db0a7cc1543p-56,
    0x1.6e1f76b4337c7p-1,
    0x1.5767717455a6cp-2,
    -0x1.fb2a49af933e8p-57,
    0x1.6c16c16c16c17p-1,
    0x1.5d1bdbf5809cap-2,
    -0x1.7dc9c7c23801fp-56,
    0x1.6a13cd1537290p-1,
    0x1.62c82f2b9c796p-2,
    -0x1.090a0dd59fe35p-58,
};

/* atan(i / 16) */
TABLE(double, atan_table, 34) = {
    0x0.0p+0,
    0x0.0p+0,
    0x1.ff55bb72cfdeap-5,
    -0x1.c934d86d23f1dp-60,
    0x1.fd5ba9aac2f6ep-4,
    -0x1.cd37686760c17p-59,
    0x1.7b97b4bce5b02p-3,
    0x1.347b0b4f881cap-58,
    0x1.f5b75f92c80ddp-3,
    0x1.8ab6e3cf7afbdp-57,
    0x1.362773707ebccp-2,
    -0x1.963a544b672d8p-57,
    0x1.6f61941e4def1p-2,
    -0x1.c63aae6f6e918p-56,
    0x1.a64eec3cc23fdp-2,
    -0x1.24dec1b50b7ffp-56,
    0x1.dac670561bb4fp-2,
    0x1.a2b7f222f65e2p-56,
    0x1.0657e94db30d0p-1,
    -0x1.d5b495f6349e6p-56,
    0x1.1e00babdefeb4p-1,
    -0x1.928df287a668fp-58,
    0x1.345f01cce37bbp-1,
    0x1.1021137c71102p-55,
    0x1.4978fa3269ee1p-1,
    0x1.2419a87f2a458p-56,
    0x1.5d58987169b18p-1,
    0x1.0028e4bc5e7cap-57,
    0x1.700a7c5784634p-1,
    -0x1.8c34d25aadef6p-56,
    0x1.819d0b7158a4dp-1,
    -0x1.bf76229d3b917p-56,
    0x1.921fb54442d18p-1,
    0x1.1a62633145c07p-55,
};

/* 2 / pi, 64 bits at a time: word i counts 2^-64i; word 0 is its whole part */
TABLE(ulong, two_over_pi, 22) = {
    0x0000000000000000UL, 0xa2f9836e4e441529UL, 0xfc2757d1f534ddc0UL, 0xdb6295993c439041UL,
    0xfe5163abdebbc561UL, 0xb7246e3a424dd2e0UL, 0x06492eea09d1921cUL, 0xfe1deb1cb129a73eUL,
    0xe88235f52ebb4484UL, 0xe99c7026b45f7e41UL, 0x3991d639835339f4UL, 0x9c845f8bbdf9283bUL,
    0x1ff897ffde05980fUL, 0xef2f118b5a0a6d1fUL, 0x6d367ecf27cb09b7UL, 0x4f463f669e5fea2dUL,
    0x7527bac7ebe5f17bUL, 0x3d0739f78a5292eaUL, 0x6bfb5fb11f8d5d08UL, 0x56033046fc7b6babUL,
    0xf0cfbc209af4361dUL, 0xa9e391615ee61b08UL,
};
