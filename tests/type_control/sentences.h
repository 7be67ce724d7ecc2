/* sentences.h - what is said in tests: ordinary sentences, of our own, in some languages. */
#ifndef LUTETIA_TEST_SENTENCES_H
#define LUTETIA_TEST_SENTENCES_H

#include <stddef.h>

enum { SENTENCES = 8 };

static const struct {
    const char *language;
    const char *of[SENTENCES];
} sentences[] = {
    {"en",
     {"The ship left the harbour before the sun was up.",
      "Nobody had counted the sailors, and nobody knew the way.",
      "Why did the elephant wait at the corner of the street?",
      "She bought seven apples, three lemons and a loaf of bread.",
      "Rain fell on the roof all night; in the morning the garden was a lake.",
      "Please close the door.",
      "A machine with sixty thousand processors is a quiet neighbour.",
      "I thought that the letters would fall, but they bounced through the window."}},
    {"de",
     {"Das Schiff verließ den Hafen, bevor die Sonne aufging.",
      "Niemand hatte die Matrosen gezählt, und niemand kannte den Weg.",
      "Warum wartet der Elefant an der Ecke der Straße?",
      "Sie kaufte sieben Äpfel, drei Zitronen und ein großes Brot.",
      "Der Regen fiel die ganze Nacht auf das Dach; am Morgen war der Garten ein See.",
      "Bitte schließen Sie die Tür.",
      "Eine Maschine mit sechzigtausend Rechnern ist eine stille Nachbarin.",
      "Ich dachte, die Buchstaben würden fallen, aber sie sprangen durch das Fenster."}},
    {"fr",
     {"Le bateau a quitté le port avant le lever du soleil.",
      "Personne n'avait compté les marins, et personne ne savait le chemin.",
      "Pourquoi l'éléphant attend-il au coin de la rue?",
      "Elle a acheté sept pommes, trois citrons et un grand pain.",
      "La pluie est tombée toute la nuit sur le toit; le matin, le jardin était un lac.",
      "Fermez la porte, s'il vous plaît.",
      "Une machine de soixante mille processeurs est une voisine tranquille.",
      "Je pensais que les lettres allaient tomber, mais elles ont sauté par la fenêtre."}},
    {"es",
     {"El barco salió del puerto antes de que saliera el sol.",
      "Nadie había contado a los marineros, y nadie sabía el camino.",
      "¿Por qué espera el elefante en la esquina de la calle?",
      "Ella compró siete manzanas, tres limones y una barra de pan.",
      "La lluvia cayó toda la noche sobre el tejado; por la mañana el jardín era un lago.",
      "Cierre la puerta, por favor.",
      "Una máquina con sesenta mil procesadores es una vecina tranquila.",
      "Pensé que las letras iban a caer, pero saltaron por la ventana."}},
    {"it",
     {"La nave lasciò il porto prima che sorgesse il sole.",
      "Nessuno aveva contato i marinai, e nessuno conosceva la strada.",
      "Perché l'elefante aspetta all'angolo della via?",
      "Lei ha comprato sette mele, tre limoni e una pagnotta di pane.",
      "La pioggia cadde tutta la notte sul tetto; al mattino il giardino era un lago.",
      "Chiudete la porta, per favore.",
      "Una macchina con sessantamila processori è una vicina silenziosa.",
      "Pensavo che le lettere sarebbero cadute, ma saltarono dalla finestra."}},
    {"ru",
     {"Корабль вышел из гавани до восхода солнца.",
      "Никто не считал матросов, и никто не знал дороги.", "Почему слон ждёт на углу улицы?",
      "Она купила семь яблок, три лимона и буханку хлеба.",
      "Дождь всю ночь стучал по крыше; утром сад был озером.", "Закройте, пожалуйста, дверь.",
      "Машина из шестидесяти тысяч процессоров тихая соседка.",
      "Я думал, что буквы упадут, но они прыгнули в окно."}},
    {"hi",
     {"जहाज़ सूरज निकलने से पहले बंदरगाह से चला गया।",
      "किसी ने नाविकों को नहीं गिना, और कोई रास्ता नहीं जानता था।", "हाथी सड़क के कोने पर क्यों रुका है?",
      "उसने सात सेब, तीन नींबू और एक रोटी खरीदी।",
      "सारी रात छत पर बारिश होती रही, सुबह बगीचा झील बन गया।", "कृपया दरवाज़ा बंद कीजिए।",
      "हज़ारों गणकों वाली मशीन एक शांत पड़ोसी है।", "मैंने सोचा कि अक्षर गिरेंगे, पर वे खिड़की से कूद गए।"}},
    {"ar",
     {"غادرت السفينة الميناء قبل شروق الشمس.", "لم يعد أحد البحارة، ولم يعرف أحد الطريق.",
      "لماذا ينتظر الفيل عند زاوية الشارع؟", "اشترت سبع تفاحات وثلاث ليمونات ورغيف خبز.",
      "سقط المطر على السقف طوال الليل، وفي الصباح كانت الحديقة بحيرة.", "من فضلك أغلق الباب.",
      "آلة فيها آلاف المعالجات جارة هادئة.", "ظننت أن الحروف ستسقط، لكنها قفزت من النافذة."}},
};

enum { LANGUAGES = sizeof sentences / sizeof *sentences };

#endif
